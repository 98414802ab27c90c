#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/Image.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/optical_axes.h"
#include "ros/bag_file.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"
#include "tools/import_sequence/bag_header.h"
#include "tools/import_sequence/frame_reader.h"
#include "tools/import_sequence/monoslam_sequence.h"
#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {
namespace {

constexpr double kRate_hz = 30.0;
constexpr double kFocal_px = 195.0;
constexpr double kBend_per_px2 = 9e-6;
constexpr double kRectifiedFocal_px = 150.0;

tf2_msgs::TFMessage cameraMounting(double time_s) {
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.linear() = opticalToBody();
  tf2_msgs::TFMessage message;
  message.transforms.push_back(tf2::eigenToTransform(T_base_camera));
  message.transforms[0].header = headerOf(time_s, ros_io::frames::kBase, 0);
  message.transforms[0].child_frame_id = ros_io::frames::kLeftOptical;
  return message;
}

}  // namespace

sensor_msgs::CameraInfo monoslamInfo() {
  sensor_msgs::CameraInfo info;
  info.width = 320;
  info.height = 240;
  info.distortion_model = "rational_polynomial";
  // 1 / sqrt(1 + x) = (64 + 80 x + 24 x^2 + x^3) / (64 + 112 x + 56 x^2 + 7 x^3), x = c r^2.
  const double c = 2.0 * kBend_per_px2 * kFocal_px * kFocal_px;
  info.D = {80.0 / 64.0 * c,     24.0 / 64.0 * c * c,   0.0, 0.0, 1.0 / 64.0 * c * c * c, 112.0 / 64.0 * c,
            56.0 / 64.0 * c * c, 7.0 / 64.0 * c * c * c};
  info.K = {kFocal_px, 0.0, 162.0, 0.0, kFocal_px, 125.0, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {kRectifiedFocal_px, 0.0, 162.0, 0.0, 0.0, kRectifiedFocal_px, 125.0, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

std::size_t importMonoslam(const std::string& folder, const std::string& bag_path) {
  const auto frames = readImageFiles(listImages(folder + "/frames"));
  ros_io::BagFile bag(bag_path);
  const auto mounting = cameraMounting(kStartTime_s);
  bag.writeLatched(ros_io::topics::kTfStatic, mounting.transforms[0].header.stamp, mounting);
  sensor_msgs::CameraInfo info = monoslamInfo();
  for (std::size_t i = 0; i < frames->size(); ++i) {
    cv::Mat image = frames->read(i);
    if (image.channels() == 3) cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
    if (image.cols != static_cast<int>(info.width) || image.rows != static_cast<int>(info.height))
      throw InputError(folder + "/frames: image " + std::to_string(i) + " is " + std::to_string(image.cols) +
                       "x" + std::to_string(image.rows) + ", those of the MonoSLAM sequence are 320x240");
    info.header = headerOf(kStartTime_s + static_cast<double>(i) / kRate_hz, ros_io::frames::kLeftOptical, i);
    bag.write(ros_io::topics::kLeftInfo, info.header.stamp, info);
    bag.write(ros_io::topics::kLeftImage, info.header.stamp,
              *cv_bridge::CvImage(info.header, "mono8", image).toImageMsg());
  }
  bag.commit();
  return frames->size();
}

}  // namespace stereo_nav::tools
