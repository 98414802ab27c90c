#include "mapping/loop/landmark_match.h"

#include <cmath>

#include "vision/reprojection.h"
#include "vision/stereo_view.h"

namespace stereo_nav::mapping {
namespace {

/// A place is told apart neither by points behind the camera nor by those right before it.
constexpr double kNearest_m = 0.05;

}  // namespace

void setPoint(const vision::StereoCalibration& calibration, const vision::KeyframeCorner& corner,
              LandmarkMatch& match) {
  match.p_place = calibration.backProject(corner.px.x(), corner.px.y(), corner.disparity_px);
  // The corner itself is what is matched: its own position is part of the corner's sigma of the residual, and
  // only its depth is uncertain besides.
  const Eigen::Vector3d by_disparity = -match.p_place / corner.disparity_px;
  match.covariance = std::pow(corner.disparity_sigma_px, 2) * by_disparity * by_disparity.transpose();
}

Eigen::Vector3d measurementOf(const vision::StereoCalibration& calibration, const Eigen::Vector3d& p_query) {
  return {calibration.fx * p_query.x() / p_query.z() + calibration.cx,
          calibration.fy * p_query.y() / p_query.z() + calibration.cy,
          calibration.fx * calibration.baseline_m / p_query.z()};
}

Eigen::Matrix3d measurementJacobian(const vision::StereoCalibration& calibration,
                                    const Eigen::Vector3d& p_query) {
  const double inverse_z = 1.0 / p_query.z();
  const Eigen::Vector2d ray = p_query.head<2>() * inverse_z;
  Eigen::Matrix3d jacobian;
  jacobian << calibration.fx, 0.0, -calibration.fx * ray.x(), 0.0, calibration.fy, -calibration.fy * ray.y(),
      0.0, 0.0, -calibration.fx * calibration.baseline_m * inverse_z;
  return inverse_z * jacobian;
}

std::optional<MatchResidual> residualOf(const vision::StereoCalibration& calibration,
                                        const Eigen::Isometry3d& T_query_place, const LandmarkMatch& match) {
  const Eigen::Vector3d p_query = T_query_place * match.p_place;
  if (p_query.z() < kNearest_m) return std::nullopt;
  const Eigen::Matrix3d by_point = measurementJacobian(calibration, p_query);
  MatchResidual residual;
  residual.error = Eigen::Vector3d(match.seen.px.x(), match.seen.px.y(), match.seen.disparity_px) -
                   measurementOf(calibration, p_query);
  residual.by_pose = by_point * vision::perturbationJacobian(p_query);
  const Eigen::Matrix3d in_query =
      T_query_place.linear() * match.covariance * T_query_place.linear().transpose();
  Eigen::Matrix3d covariance = by_point * in_query * by_point.transpose();
  covariance.diagonal().head<2>().array() += kCornerSigma_px * kCornerSigma_px;
  residual.information.setZero();
  if (match.seen.hasDepth()) {
    covariance(2, 2) += std::pow(match.seen.disparity_sigma_px, 2);
    residual.information = covariance.inverse();
    residual.dimensions = 3;
  } else {
    residual.error.z() = 0.0;
    residual.information.topLeftCorner<2, 2>() = covariance.topLeftCorner<2, 2>().inverse();
    residual.dimensions = 2;
  }
  residual.squared = residual.error.dot(residual.information * residual.error);
  return residual;
}

}  // namespace stereo_nav::mapping
