#include "odometry/laser/motion_covariance.h"

namespace stereo_nav::odometry {

/// The error of the later pose less that of the earlier one, which moves along: with the nine errors x of the
/// filter, e = S x, of later = e_to - Phi e_from.
Eigen::Matrix3d motionCovariance(const FilterMoment& from, const Matrix9d& transition,
                                 const FilterMoment& to) {
  Eigen::Matrix<double, 3, 9> S = Eigen::Matrix<double, 3, 9>::Zero();
  S.leftCols<3>().setIdentity();
  S.middleCols<3>(3).setIdentity();
  const Eigen::Vector2d way = to.T_odom_base.translation() - from.T_odom_base.translation();
  Eigen::Matrix3d Phi = Eigen::Matrix3d::Identity();
  Phi(0, 2) = -way.y();
  Phi(1, 2) = way.x();
  const Eigen::Matrix3d of_to = S * to.covariance * S.transpose();
  const Eigen::Matrix3d of_from = Phi * S * from.covariance * S.transpose() * Phi.transpose();
  const Eigen::Matrix3d shared = S * transition * from.covariance * S.transpose() * Phi.transpose();
  const Eigen::Matrix3d in_odom = of_to + of_from - shared - shared.transpose();
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R.topLeftCorner<2, 2>() = to.T_odom_base.linear();
  return R.transpose() * in_odom * R;
}

}  // namespace stereo_nav::odometry
