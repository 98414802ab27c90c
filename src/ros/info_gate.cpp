#include "ros/info_gate.h"

#include <algorithm>
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
  camera.info_stamps.push_back(info->header.stamp);
  if (camera.info_stamps.size() > kWaiting) camera.info_stamps.pop_front();
  for (Image& image : camera.images) image.has_info |= image.header.stamp == info->header.stamp;
  if (!camera.seldom) keepWaiting(camera, info->header);
  judge();
  return passOn();
}

std::vector<InfoGate::Passed> InfoGate::addImage(Side side, const std_msgs::Header& header,
                                                 const cv::Size& size, double now_s) {
  Camera& camera = cameras_[side];
  if (camera.image_size != size) judged_.reset();
  camera.image_size = size;
  if (camera.seldom) {
    keepWaiting(camera, header);
  } else if (camera.info && camera.images.size() < kCompared) {
    const auto& stamps = camera.info_stamps;
    const bool has_info = std::find(stamps.begin(), stamps.end(), header.stamp) != stamps.end();
    camera.images.push_back({header, now_s, has_info});
  }
  judge();
  return passOn();
}

std::vector<InfoGate::Passed> InfoGate::passOnOverdue(double now_s) {
  for (Camera& camera : cameras_) giveOverdue(camera, now_s);
  return passOn();
}

void InfoGate::giveOverdue(Camera& camera, double now_s) {
  constexpr double kPatience_s = 0.1;  // an info comes with its image
  for (Image& image : camera.images) {
    if (image.has_info || now_s < image.arrival_s + kPatience_s) continue;
    image.has_info = true;
    keepWaiting(camera, image.header);
    ++camera.without_info;
  }
  camera.seldom = 2 * camera.without_info > kCompared;
}

bool InfoGate::needsImages(Side side) const {
  const Camera& camera = cameras_[side];
  const auto waits = [](const Image& image) { return !image.has_info; };
  return !camera.image_size || camera.seldom || camera.images.size() < kCompared ||
         std::any_of(camera.images.begin(), camera.images.end(), waits);
}

std::vector<std::string> InfoGate::notes() const {
  std::vector<std::string> notes = notes_;
  for (const Side side : {kLeft, kRight}) {
    if (!cameras_[side].seldom) continue;
    notes.push_back(std::string(side == kLeft ? "left" : "right") +
                    " camera_info comes more seldom than the images: the latest one is used for each");
  }
  return notes;
}

void InfoGate::keepWaiting(Camera& camera, const std_msgs::Header& header) {
  camera.waiting.push_back(header);
  if (camera.waiting.size() > kWaiting) camera.waiting.pop_front();
}

void InfoGate::judge() {
  if (judged_ || !cameras_[kLeft].fresh || !cameras_[kRight].fresh) return;
  try {
    JudgedInfos judged = judgeInfos(*cameras_[kLeft].info, *cameras_[kRight].info);
    if (!cameras_[kLeft].image_size || !cameras_[kRight].image_size) return;
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
    for (const std_msgs::Header& header : cameras_[side].waiting) {
      const auto judged =
          boost::make_shared<sensor_msgs::CameraInfo>(side == kLeft ? judged_->left : judged_->right);
      judged->header = header;
      passed.push_back({side, judged});
    }
    cameras_[side].waiting.clear();
  }
  return passed;
}

}  // namespace stereo_nav::ros_io
