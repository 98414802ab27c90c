#include "vision/disparity_lifter.h"

#include <cmath>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::vision {

void DisparityLifterParams::describe(ParameterVisitor& visitor) {
  visitor.real("min_disparity_px", min_disparity_px, {0.0, 1000.0}, "px",
               "smaller disparities are too far to be measured and count as none");
}

DisparityLifter::DisparityLifter(const DisparityLifterParams& params, const StereoCalibration& calibration)
    : params_(params), calibration_(calibration) {
  validateParameters(params, "depth");
  calibration.validate();
}

std::optional<DisparityLifter::Lifted> DisparityLifter::lift(const cv::Mat& disparity,
                                                             const cv::Point2f& pixel) const {
  const long column = std::lround(pixel.x);
  const long row = std::lround(pixel.y);
  if (column < 0 || row < 0 || column >= disparity.cols || row >= disparity.rows) return std::nullopt;
  const auto d = static_cast<double>(disparity.at<float>(static_cast<int>(row), static_cast<int>(column)));
  if (!(d > 0.0) || d < params_.min_disparity_px || !std::isfinite(d)) return std::nullopt;
  return Lifted{calibration_.backProject(pixel.x, pixel.y, d), d};
}

}  // namespace stereo_nav::vision
