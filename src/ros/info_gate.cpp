#include "ros/info_gate.h"

#include <boost/make_shared.hpp>

#include "ros/setup_checks.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::ros_io {

std::vector<InfoGate::Passed> InfoGate::addInfo(Side side, const sensor_msgs::CameraInfoConstPtr& info) {
  Camera& camera = cameras_[side];
  if (camera.info && !sameCamera(*camera.info, *info)) {
    camera.image_size.reset();
    camera.waiting.clear();
    // What the other camera sent earlier may be of the calibration before.
    Camera& other = cameras_[side == kLeft ? kRight : kLeft];
    other.fresh = other.info && other.info->header.stamp >= info->header.stamp;
    judged_.reset();
  }
  camera.info = info;
  camera.fresh = true;
  camera.waiting.push_back(info);
  if (camera.waiting.size() > kWaiting) camera.waiting.pop_front();
  judge();
  return passOn();
}

std::vector<InfoGate::Passed> InfoGate::addImageSize(Side side, const cv::Size& size) {
  cameras_[side].image_size = size;
  judge();
  return passOn();
}

void InfoGate::judge() {
  if (judged_ || !cameras_[kLeft].fresh || !cameras_[kRight].fresh) return;
  try {
    JudgedInfos judged = judgeInfos(*cameras_[kLeft].info, *cameras_[kRight].info);
    if (needsImageSize(kLeft) || needsImageSize(kRight)) return;
    checkSize("left", cameras_[kLeft], judged.left);
    checkSize("right", cameras_[kRight], judged.right);
    problem_.clear();
    notes_ = judged.notes;
    judged_ = std::move(judged);
  } catch (const std::exception& error) {
    problem_ = error.what();
  }
}

void InfoGate::checkSize(const char* name, Camera& camera, const sensor_msgs::CameraInfo& judged) {
  const cv::Size size = *camera.image_size;
  const cv::Size expected(static_cast<int>(judged.width), static_cast<int>(judged.height));
  if (size == expected) return;
  camera.image_size.reset();  // the driver may be set to the right size
  throw InputError(
      std::string("the ") + name + " raw image is " + vision::sizeText(size) + ", its camera_info is for " +
      vision::sizeText(expected) +
      " (width and height, less roi and binning); calibrate at the size that the camera delivers, "
      "or have the driver publish the roi and binning that it uses");
}

std::vector<InfoGate::Passed> InfoGate::passOn() {
  std::vector<Passed> passed;
  if (!judged_) return passed;
  for (const Side side : {kLeft, kRight}) {
    for (const auto& info : cameras_[side].waiting) {
      const auto judged =
          boost::make_shared<sensor_msgs::CameraInfo>(side == kLeft ? judged_->left : judged_->right);
      judged->header = info->header;
      passed.push_back({side, judged});
    }
    cameras_[side].waiting.clear();
  }
  return passed;
}

}  // namespace stereo_nav::ros_io
