#include "ros/setup_checks.h"

#include <fmt/format.h>

#include <cmath>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {
namespace {

std::string sizeText(unsigned int width, unsigned int height) {
  return vision::sizeText({static_cast<int>(width), static_cast<int>(height)});
}

void checkImage(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& info,
                const std::string& side) {
  if (withoutSlash(image.header.frame_id) != withoutSlash(info.header.frame_id)) {
    throw InputError("the " + side + " image is in frame '" + image.header.frame_id +
                     "', its camera_info in '" + info.header.frame_id +
                     "'; let the driver publish both with the left camera's optical frame");
  }
  if (image.width != info.width || image.height != info.height) {
    throw InputError(
        "the " + side + " image is " + sizeText(image.width, image.height) + ", its camera_info is for " +
        sizeText(info.width, info.height) +
        "; calibrate at the size that the camera delivers; camera_info must hold the binning and roi that "
        "it uses");
  }
}

}  // namespace

std::string withoutSlash(const std::string& frame_id) {
  return !frame_id.empty() && frame_id.front() == '/' ? frame_id.substr(1) : frame_id;
}

JudgedInfos checkedInfos(const sensor_msgs::Image& left, const sensor_msgs::Image& right,
                         const sensor_msgs::CameraInfo& left_info,
                         const sensor_msgs::CameraInfo& right_info) {
  if (left.header.frame_id.empty()) {
    throw InputError(
        "the left image carries no frame id, so that the position of the camera is unknown; set the frame_id "
        "parameter of the camera driver");
  }
  JudgedInfos infos = judgeInfos(left_info, right_info);
  checkImage(left, infos.left, "left");
  checkImage(right, infos.right, "right");
  return infos;
}

bool sameCamera(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b) {
  return a.header.frame_id == b.header.frame_id && a.width == b.width && a.height == b.height && a.K == b.K &&
         a.D == b.D && a.R == b.R && a.P == b.P && a.distortion_model == b.distortion_model &&
         a.binning_x == b.binning_x && a.binning_y == b.binning_y && a.roi.x_offset == b.roi.x_offset &&
         a.roi.y_offset == b.roi.y_offset && a.roi.width == b.roi.width && a.roi.height == b.roi.height;
}

std::string swappedCameras() {
  return "left and right images are swapped: most corners of the left image lie further right in the right "
         "image (negative disparity), which is impossible in a correctly ordered rectified pair; depth and "
         "odometry are wrong. Exchange the two cameras' device numbers (left_device, right_device), plugs or "
         "topics";
}

std::string wrongRightStamps(double error_s) {
  return fmt::format(
      "the stamps of the right images are {:.1f} ms too {}: where the rig moves, the right camera sees the rows of "
      "another time than it says. The error is taken off; have the driver stamp both cameras in the same way",
      1e3 * std::abs(error_s), error_s > 0.0 ? "late" : "early");
}

std::string missingTransform(const std::string& base_frame, const std::string& sensor_frame,
                             bool sensor_is_camera, const std::string& tf_error) {
  const std::string example = sensor_is_camera ? "0 0 0.283 -1.5708 0 -1.5708" : "0 0 0 0 0 0";
  const std::string mounting = sensor_is_camera ? "a camera 0.283 m above the base that looks straight ahead"
                                                : "a sensor at the base's origin with the base's axes";
  return "waiting for the transform " + base_frame + " -> " + sensor_frame + " in tf (" + tf_error +
         "). Nothing tells where the sensor sits: start robot_state_publisher, or measure and publish it, "
         "e.g. for " +
         mounting + " (x y z yaw pitch roll): rosrun tf2_ros static_transform_publisher " + example + " " +
         base_frame + " " + sensor_frame;
}

}  // namespace stereo_nav::ros_io
