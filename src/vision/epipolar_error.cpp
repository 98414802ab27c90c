#include "vision/epipolar_error.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "vision/stereo_view.h"

namespace stereo_nav::vision {
namespace {

constexpr double kMatchSigma_px = kPixelSigma_px;

}  // namespace

void EpipolarErrorParams::describe(ParameterVisitor& visitor) {
  visitor.real(
      "prior_sigma_px", prior_sigma_px, {1e-3, 50.0}, "px",
      "how far off the rows of the two rectified images may be; small values hold to the calibration");
  visitor.real("memory", memory, {10.0, 1e6}, "matches",
               "number of matches that the estimate rests on at most");
}

EpipolarError::EpipolarError(const EpipolarErrorParams& params, const StereoCalibration& calibration)
    : params_(params), calibration_(calibration) {
  const double ratio = kMatchSigma_px / params.prior_sigma_px;
  prior_ = ratio * ratio * Eigen::Matrix3d::Identity();
  coefficients_px_.setZero();
  information_.setZero();
  moments_.setZero();
}

Eigen::Vector3d EpipolarError::basis(const Eigen::Vector2d& right_px) const {
  return {1.0, (right_px.x() - calibration_.right_cx) / calibration_.fx,
          (right_px.y() - calibration_.cy) / calibration_.fy};
}

Eigen::Vector2d EpipolarError::at(const Eigen::Vector2d& right_px) const {
  const Eigen::Vector3d along = basis(right_px);
  const double x = along(1);
  const double y = along(2);
  const Eigen::Vector3d columns(x * y, -y, x);
  return {columns.dot(coefficients_px_), along.dot(coefficients_px_)};
}

double EpipolarError::slack_px() const {
  return 3.0 * kMatchSigma_px / std::sqrt(information_(0, 0) + prior_(0, 0));
}

void EpipolarError::add(const Eigen::Vector2d& right_px, double error_px) {
  const Eigen::Vector3d along = basis(right_px);
  // Where little is known yet, a large error is no outlier.
  const double scale_px = kMatchSigma_px + slack_px();
  const double off = (error_px - along.dot(coefficients_px_)) / scale_px;
  const double weight = 1.0 / (1.0 + off * off);
  information_ += weight * along * along.transpose();
  moments_ += weight * error_px * along;
}

void EpipolarError::learn() {
  coefficients_px_ = (information_ + prior_).ldlt().solve(moments_);
  const double fading = std::min(1.0, params_.memory / std::max(1.0, information_(0, 0)));
  information_ *= fading;
  moments_ *= fading;
}

}  // namespace stereo_nav::vision
