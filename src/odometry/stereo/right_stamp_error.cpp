#include "odometry/stereo/right_stamp_error.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "vision/stereo_view.h"

namespace stereo_nav::odometry {
namespace {

/// Matches, a few hundred a frame, from which on the errors of the rows are known well enough.
constexpr double kFewestMatches = 1000.0;
/// Matches that the estimate rests on at most, some minutes: rows go off as a rig warms up.
constexpr double kMemory = 1e6;
/// Matches that share their error: those of a feature, from frame to frame (docs/method.md).
constexpr double kDependentMatches = 30.0;
/// px, what lenses leave of rows that no linear function takes away; it does not average out while the motion
/// stays the same. The public recordings show half of it.
constexpr double kLensSigma_px = 0.02;
/// Half a pixel at a turn of 30 degrees a second and a focal length of 350 px.
constexpr double kSmallestError_s = 3e-3;
constexpr double kCertainty_sigma = 5.0;

}  // namespace

bool RightStampError::Estimate::isCertain() const {
  return std::abs(error_s) > kSmallestError_s && std::abs(error_s) > kCertainty_sigma * sigma_s;
}

void RightStampError::add(const Eigen::Vector3d& basis, double error_px, double px_per_s) {
  const Eigen::Vector4d along(basis.x(), basis.y(), basis.z(), px_per_s);
  // Where little is known yet, a large error is no outlier.
  const double known = information_(0, 0) / kFewestMatches;
  const double scale_px = vision::kPixelSigma_px * (known < 1.0 ? 10.0 : 3.0);
  const double off = (error_px - along.dot(coefficients_)) / scale_px;
  const double weight = 1.0 / (1.0 + off * off);
  information_ += weight * along * along.transpose();
  moments_ += weight * error_px * along;
  squares_px2_ += weight * error_px * error_px;
}

void RightStampError::learn() {
  // So little that it decides nothing where something is known.
  const Eigen::Vector4d least(1e-3, 1e-3, 1e-3, 1.0);
  coefficients_ = (information_ + Eigen::Matrix4d(least.asDiagonal())).ldlt().solve(moments_);
  const auto found = rest();
  if (!found || !found->isCertain()) {
    const double fading = std::min(1.0, kMemory / std::max(1.0, information_(0, 0)));
    information_ *= fading;
    moments_ *= fading;
    squares_px2_ *= fading;
    return;
  }
  const double taken_off_s = taken_off_s_ + found->error_s;
  *this = RightStampError();
  taken_off_s_ = taken_off_s;
}

std::optional<RightStampError::Estimate> RightStampError::estimate() const {
  auto estimate = rest();
  if (estimate) estimate->error_s += taken_off_s_;
  return estimate;
}

std::optional<RightStampError::Estimate> RightStampError::rest() const {
  const double matches = information_(0, 0);
  if (matches < kFewestMatches) return std::nullopt;
  // What of the flow no displacement of the rows explains: the Schur complement of the time.
  const Eigen::Matrix3d rows = information_.topLeftCorner<3, 3>();
  const Eigen::Vector3d shared = information_.topRightCorner<3, 1>();
  const double own = information_(3, 3) - shared.dot(rows.ldlt().solve(shared));
  if (!(own > 0.0)) return std::nullopt;
  const double noise_px2 = std::max(0.0, squares_px2_ - coefficients_.dot(moments_)) / matches;
  const double variance_s2 =
      kDependentMatches * noise_px2 / own + kLensSigma_px * kLensSigma_px * matches / own;
  return Estimate{coefficients_(3), std::sqrt(variance_s2)};
}

}  // namespace stereo_nav::odometry
