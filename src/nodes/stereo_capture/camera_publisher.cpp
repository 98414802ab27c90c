#include "nodes/stereo_capture/camera_publisher.h"

#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <utility>

#include "ros/calibration_url.h"

namespace stereo_nav::nodes {
namespace {

constexpr std::uint32_t kQueue = 4;  // short, so that a slow subscriber gets the newest images
constexpr const char* kPackageUrl = "package://stereo_nav/";

}  // namespace

CameraPublisher::CameraPublisher(const ros::NodeHandle& handle, const std::string& name,
                                 const std::string& calibration_url, const std::string& frame_id)
    : transport_(handle),
      publisher_(transport_.advertiseCamera("image_raw", kQueue)),
      name_(name),
      url_(calibration_url.empty() ? ros_io::kDefaultCalibrationUrl : calibration_url),
      frame_id_(frame_id),
      calibration_(handle, name, url_) {
  calibration_.loadCameraInfo(url_);
}

void CameraPublisher::publish(camera::Frame& frame, const ros::Time& stamp) {
  const auto image = boost::make_shared<sensor_msgs::Image>();
  image->header.stamp = stamp;
  image->header.frame_id = frame_id_;
  image->width = static_cast<std::uint32_t>(frame.image.width);
  image->height = static_cast<std::uint32_t>(frame.image.height);
  image->encoding = camera::encodingName(frame.image.encoding);
  image->step = static_cast<std::uint32_t>(frame.image.step());
  image->data = std::move(frame.image.pixels);

  const auto info = boost::make_shared<sensor_msgs::CameraInfo>(calibration_.getCameraInfo());
  if (info->width != image->width || info->height != image->height) *info = sensor_msgs::CameraInfo();
  info->header = image->header;
  info->width = image->width;
  info->height = image->height;
  publisher_.publish(image, info);
}

sensor_msgs::CameraInfo CameraPublisher::calibration() {
  sensor_msgs::CameraInfo info = calibration_.getCameraInfo();
  info.header.frame_id = frame_id_;
  return info;
}

std::string CameraPublisher::calibrationWarning() const {
  if (url_.rfind(kPackageUrl, 0) != 0) return {};
  return name_ + " camera: " + url_ +
         " is the example that comes with the package, for the thesis' own camera: with any other camera it "
         "gives wrong distances, and the calibrator's COMMIT overwrites it. Remove `calibration` from the "
         "rig file, or name a file of your own there, and calibrate (docs/calibration.md)";
}

std::string CameraPublisher::urlText() {
  return calibration_.resolveURL(url_, name_);
}

std::string CameraPublisher::calibrationProblem(int width, int height) {
  const std::string remedy =
      "; calibrate the cameras (docs/capture.md tells how) or give the right file as `calibration` in the "
      "rig. Raw images are published nevertheless, rectified images and disparity are not";
  if (!calibration_.validateURL(url_)) {
    return name_ + " camera: the calibration URL " + url_ +
           " is not of the form file:///path or package://package/path" + remedy;
  }
  if (!calibration_.isCalibrated()) {
    return name_ + " camera: no calibration: " + urlText() + " is missing or cannot be read" + remedy;
  }
  const auto info = calibration_.getCameraInfo();
  if (info.width == static_cast<std::uint32_t>(width) && info.height == static_cast<std::uint32_t>(height))
    return {};
  return name_ + " camera: the calibration " + urlText() + " is for " + std::to_string(info.width) + "x" +
         std::to_string(info.height) + " images, the camera gives " + std::to_string(width) + "x" +
         std::to_string(height) + remedy;
}

}  // namespace stereo_nav::nodes
