#include "stereo_nav/ros/conversions.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "ros/judged_infos.h"
#include "stereo_nav/core/input_error.h"
#include "vision/lens_model.h"

namespace stereo_nav::ros_io {
namespace {

namespace enc = sensor_msgs::image_encodings;

bool isSupported(const std::string& encoding) {
  static const std::vector<std::string> supported = {
      enc::MONO8,        enc::MONO16,      enc::RGB8,         enc::BGR8,         enc::RGBA8,
      enc::BGRA8,        enc::RGB16,       enc::BGR16,        enc::BAYER_RGGB8,  enc::BAYER_BGGR8,
      enc::BAYER_GBRG8,  enc::BAYER_GRBG8, enc::BAYER_RGGB16, enc::BAYER_BGGR16, enc::BAYER_GBRG16,
      enc::BAYER_GRBG16, enc::YUV422};
  return std::find(supported.begin(), supported.end(), encoding) != supported.end();
}

}  // namespace

vision::StereoCalibration toCalibration(const sensor_msgs::CameraInfo& left,
                                        const sensor_msgs::CameraInfo& right) {
  return judgeInfos(left, right).calibration;
}

cv::Mat toMono8(const sensor_msgs::ImageConstPtr& image) {
  if (!isSupported(image->encoding)) {
    throw InputError(
        "image encoding '" + image->encoding +
        "' is not supported; record mono8, mono16, rgb8, bgr8, rgba8, bgra8, rgb16, bgr16, a Bayer "
        "pattern of 8 or 16 bits or yuv422");
  }
  const auto pixel_bytes = static_cast<std::size_t>(enc::numChannels(image->encoding)) *
                           static_cast<std::size_t>(enc::bitDepth(image->encoding)) / 8;
  const bool complete = image->width > 0 && image->height > 0 && image->step >= image->width * pixel_bytes &&
                        image->data.size() == static_cast<std::size_t>(image->step) * image->height;
  if (!complete) {
    std::ostringstream message;
    message << "image of " << image->width << "x" << image->height << " '" << image->encoding << "', step "
            << image->step << " has " << image->data.size() << " bytes; the message is damaged";
    throw InputError(message.str());
  }
  try {
    if (enc::isMono(image->encoding)) return cv_bridge::toCvShare(image, enc::MONO8)->image;
    return cv_bridge::toCvCopy(image, enc::MONO8)->image;
  } catch (const cv_bridge::Exception& error) {
    throw InputError(std::string("image cannot be converted to grey: ") + error.what());
  }
}

cv::Mat rawRows(const sensor_msgs::CameraInfo& info) {
  return vision::rawPixels(toFields(info)).rows;
}

cv::Mat toDisparityMap(const stereo_msgs::DisparityImage& message,
                       const vision::StereoCalibration& calibration) {
  const sensor_msgs::Image& image = message.image;
  const bool fits = image.encoding == enc::TYPE_32FC1 && static_cast<int>(image.width) == calibration.width &&
                    static_cast<int>(image.height) == calibration.height &&
                    image.step >= image.width * sizeof(float) &&
                    image.data.size() >= static_cast<std::size_t>(image.step) * image.height;
  if (!fits) {
    std::ostringstream text;
    text << "disparity is " << image.width << "x" << image.height << " '" << image.encoding << "', expected "
         << calibration.width << "x" << calibration.height << " '32FC1'";
    throw InputError(text.str());
  }
  // The Mat is only read; OpenCV has no constructor for constant data.
  const cv::Mat shared(static_cast<int>(image.height), static_cast<int>(image.width), CV_32FC1,
                       const_cast<unsigned char*>(image.data.data()), image.step);
  cv::Mat map = shared.clone();
  const double smallest = message.min_disparity - (calibration.cx - calibration.right_cx);
  constexpr double kHalfStep = 0.5;  // the marker lies a whole pixel below
  map.setTo(-1.0F, map < smallest - kHalfStep);
  return map;
}

ImuSample toImuSample(const sensor_msgs::Imu& imu) {
  ImuSample sample;
  sample.time_s = imu.header.stamp.toSec();
  const auto& q = imu.orientation;
  const bool has_orientation =
      imu.orientation_covariance[0] != -1.0 && !(q.w == 0.0 && q.x == 0.0 && q.y == 0.0 && q.z == 0.0);
  if (has_orientation) sample.q_world_imu = Eigen::Quaterniond(q.w, q.x, q.y, q.z);
  if (imu.angular_velocity_covariance[0] != -1.0) {
    sample.angular_velocity =
        Eigen::Vector3d(imu.angular_velocity.x, imu.angular_velocity.y, imu.angular_velocity.z);
  }
  if (imu.linear_acceleration_covariance[0] != -1.0) {
    sample.linear_acceleration =
        Eigen::Vector3d(imu.linear_acceleration.x, imu.linear_acceleration.y, imu.linear_acceleration.z);
  }
  return sample;
}

Eigen::Isometry3d toIsometry(const geometry_msgs::Transform& transform) {
  const auto& q = transform.rotation;
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  isometry.translation() << transform.translation.x, transform.translation.y, transform.translation.z;
  return isometry;
}

}  // namespace stereo_nav::ros_io
