#include "odometry/stereo/frame_check.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace stereo_nav::odometry {
namespace {

void checkImages(const StereoFrame& frame, const vision::StereoCalibration& calibration) {
  const cv::Size expected(calibration.width, calibration.height);
  for (const cv::Mat* image : {&frame.left, &frame.right}) {
    if (image->type() == CV_8UC1 && image->size() == expected) continue;
    std::ostringstream message;
    message << (image == &frame.left ? "left" : "right") << " image is " << image->cols << "x" << image->rows
            << " of OpenCV type " << image->type() << ", calibration is for " << expected.width << "x"
            << expected.height << " of 8 bit grey: is camera_info of another resolution than the images?";
    throw std::invalid_argument(message.str());
  }
}

void checkStamps(const StereoFrame& frame) {
  constexpr double kLargestTimeOffset_s = 1.0;
  if (std::isfinite(frame.left_time_s) &&
      std::abs(frame.right_time_s - frame.left_time_s) <= kLargestTimeOffset_s)
    return;
  std::ostringstream message;
  message << std::fixed << "the left image was taken at " << frame.left_time_s << " s, the right one at "
          << frame.right_time_s << " s: these are no pair; are both cameras stamped by one clock?";
  throw std::invalid_argument(message.str());
}

void checkReadout(const StereoFrame& frame) {
  if (frame.readout_s >= 0.0 && frame.readout_s <= kLongestReadout_s) return;
  std::ostringstream message;
  message << "the rows of the images were taken within " << frame.readout_s
          << " s, which no rolling shutter does (0 to " << kLongestReadout_s
          << " s, 0: global shutter); look at rolling_shutter_s of camera/sync";
  throw std::invalid_argument(message.str());
}

}  // namespace

void checkFrame(const StereoFrame& frame, const vision::StereoCalibration& calibration) {
  checkImages(frame, calibration);
  checkStamps(frame);
  checkReadout(frame);
}

void checkOrder(const StereoFrame& frame, double previous_left_time_s) {
  if (frame.left_time_s > previous_left_time_s) return;
  std::ostringstream message;
  message << "a frame at " << std::fixed << frame.left_time_s << " s came after one at "
          << previous_left_time_s
          << " s: each must be later than the one before; reset() lets a recording begin again";
  throw std::invalid_argument(message.str());
}

}  // namespace stereo_nav::odometry
