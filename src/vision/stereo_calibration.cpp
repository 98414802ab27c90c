#include "stereo_nav/vision/stereo_calibration.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace stereo_nav::vision {
namespace {

void require(bool holds, const char* what, double seen, const char* remedy) {
  if (holds) return;
  std::ostringstream message;
  message << "stereo calibration: " << what << " is " << seen << "; " << remedy;
  throw std::invalid_argument(message.str());
}

}  // namespace

void StereoCalibration::validate() const {
  const char* const recalibrate =
      "the projection matrices P of the camera_infos are wrong; calibrate the pair again";
  require(std::isfinite(fx) && fx > 0.0, "focal length fx [px]", fx, recalibrate);
  require(std::isfinite(fy) && fy > 0.0, "focal length fy [px]", fy, recalibrate);
  require(std::isfinite(cx), "principal point cx [px]", cx, recalibrate);
  require(std::isfinite(cy), "principal point cy [px]", cy, recalibrate);
  require(std::isfinite(right_cx), "right principal point cx [px]", right_cx, recalibrate);
  require(std::isfinite(baseline_m) && baseline_m > 0.0, "baseline [m]", baseline_m,
          "P[3] of the right camera_info must be -fx * baseline and not 0; is it from a stereo calibration, "
          "and are "
          "left and right not swapped?");
  require(width > 0, "image width [px]", width, "camera_info must hold the image size");
  require(height > 0, "image height [px]", height, "camera_info must hold the image size");
}

}  // namespace stereo_nav::vision
