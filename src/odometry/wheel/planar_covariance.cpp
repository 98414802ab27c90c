#include "odometry/wheel/planar_covariance.h"

#include "core/planar_motion.h"

namespace stereo_nav::odometry {
PlanarCovariance::PlanarCovariance(std::size_t wheels, double scale_sigma)
    : scale_variance_(scale_sigma * scale_sigma) {
  with_reading_.setZero(3, static_cast<Eigen::Index>(wheels));
  scale_gain_ = with_reading_;
}

void PlanarCovariance::reset(const Eigen::Matrix3d& covariance) {
  random_ = covariance;
  with_reading_.setZero();
  scale_gain_.setZero();
  with_drift_.setZero();
}

void PlanarCovariance::append(const WheelStep& step, const std::vector<double>& reading_variance_m2) {
  const WheelInterval& interval = step.interval;
  const IntervalMotion& motion = step.motion;
  // e_end = F e_start + J d, with J the right Jacobian of exp at the motion (Sola et al. 2018, eq. 67 and
  // 83).
  const Eigen::Matrix3d F = adjointPlanar(expPlanar(-motion.motion));
  const Eigen::Matrix3d J = leftJacobianPlanar(-motion.motion);
  const WheelColumns gain = J * motion.gain;
  const Eigen::Vector3d yaw_gain = J * motion.yaw_gain;

  // A measured drift is known better by a factor, and so is what the pose shares with it.
  if (step.yaw_drift_variance < drift_variance_) with_drift_ *= step.yaw_drift_variance / drift_variance_;
  drift_variance_ = step.yaw_drift_variance;
  const Eigen::Vector3d drift_gain = step.duration_s * yaw_gain;
  const Eigen::Matrix3d drifted = F * with_drift_ * drift_gain.transpose();

  random_ = (F * random_ * F.transpose()).eval();
  random_ += drifted + drifted.transpose() + drift_variance_ * drift_gain * drift_gain.transpose();
  random_ += J * motion.sideways_covariance * J.transpose();
  if (interval.yaw_rad) random_ += interval.yaw_variance_rad2 * yaw_gain * yaw_gain.transpose();
  for (Eigen::Index i = 0; i < gain.cols(); ++i) {
    const auto wheel = static_cast<std::size_t>(i);
    const Eigen::Vector3d g = gain.col(i);
    // The distance is the new reading minus the last one, whose error the pose may hold already.
    const Eigen::Matrix3d shared = F * with_reading_.col(i) * g.transpose();
    random_ += (step.slip_variance_m2[wheel] + 2.0 * reading_variance_m2[wheel]) * g * g.transpose() -
               shared - shared.transpose();
    with_reading_.col(i) = reading_variance_m2[wheel] * g;
    scale_gain_.col(i) = (F * scale_gain_.col(i)).eval() + interval.distance_m[wheel] * g;
  }
  with_drift_ = (F * with_drift_).eval() + drift_variance_ * drift_gain;
}

Eigen::Matrix3d PlanarCovariance::covariance() const {
  return random_ + scale_variance_ * scale_gain_ * scale_gain_.transpose();
}

}  // namespace stereo_nav::odometry
