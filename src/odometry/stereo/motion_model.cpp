#include "odometry/stereo/motion_model.h"

#include <cmath>

namespace stereo_nav::odometry {
namespace {

/// m/s and rad/s: how fast the rig may move before anything is known of it.
constexpr double kFirstTwistSigma = 1.0;

/// The motion over `time_s` of a camera that moves by `T_next_now` in the coming `after_s` and moved by
/// `T_now_before` in the past `before_s`: the parabola of twists through the three poses.
Eigen::Isometry3d interpolatedMotion(const Eigen::Isometry3d& T_next_now, double after_s,
                                     const Eigen::Isometry3d& T_now_before, double before_s, double time_s) {
  const Vector6d rate_after = logMotion(T_next_now) / after_s;
  const Vector6d rate_before = logMotion(T_now_before) / before_s;
  const Vector6d curvature = (rate_after - rate_before) / (after_s + before_s);
  const Vector6d rate = rate_after - curvature * after_s;
  return expMotion(rate * time_s + curvature * time_s * time_s);
}

}  // namespace

void MotionModelParams::describe(ParameterVisitor& visitor) {
  visitor.real("acceleration_density", acceleration_density, {1e-6, 1e6}, "m^2/s^3",
               "how much the velocity changes: its variance grows by this per second");
  visitor.real("angular_acceleration_density", angular_acceleration_density, {1e-6, 1e6}, "rad^2/s^3",
               "how much the angular rate changes: its variance grows by this per second");
}

WindowFrame MotionModel::start(const FrameTimes& times, const Eigen::Isometry3d& T_camera_world) {
  WindowFrame first;
  first.view.T_camera_world = T_camera_world;
  first.has_time_offset = times.rightOffset_s() != 0.0;
  first.late_sigma.setConstant(kFirstTwistSigma * std::abs(times.rightOffset_s()));
  if (const auto late = imu_.increment(times.left_s, times.right_s)) {
    first.view.T_late_camera.linear() = first.T_late_expected.linear() = late->R_current_previous;
    first.late_sigma.tail<3>().setConstant(late->sigma_rad);
  }
  twist_.reset();
  previous_times_ = times;
  previous_interval_s_ = 0.0;
  previous_view_ = first.view;
  trusted_ = Trusted{times.left_s, T_camera_world, std::nullopt, Vector6d::Zero()};
  return first;
}

bool MotionModel::forgetVelocity() {
  const bool known = twist_.has_value();
  twist_.reset();
  return known;
}

MotionPrior MotionModel::prior(const FrameTimes& times) const {
  MotionPrior prior;
  prior.T_previous_world = previous_view_.T_camera_world;
  prior.interval_s = times.left_s - previous_times_.left_s;
  prior.right_time_offset_s = times.rightOffset_s();
  prior.previous_twist = twist_;
  const double spread = twist_ ? 0.5 * std::sqrt(prior.interval_s) : std::sqrt(prior.interval_s);
  prior.twist_sigma.head<3>().setConstant(std::sqrt(params_.acceleration_density) * spread);
  prior.twist_sigma.tail<3>().setConstant(std::sqrt(params_.angular_acceleration_density) * spread);
  if (const auto turn = imu_.increment(previous_times_.left_s, times.left_s)) {
    prior.R_current_previous = turn->R_current_previous;
    prior.rotation_sigma_rad = turn->sigma_rad;
  }
  if (const auto late = imu_.increment(times.left_s, times.right_s)) {
    prior.R_late_camera = late->R_current_previous;
  }
  return prior;
}

Coasted MotionModel::coasted(const FrameTimes& times, double coasting_s) const {
  Coasted coasted;
  if (!trusted_) return coasted;
  const double lost_s = times.left_s - trusted_->time_s;
  const double time_s = trusted_->twist ? std::min(lost_s, coasting_s) : 0.0;
  coasted.velocity_is_known = trusted_->twist && lost_s <= coasting_s;
  Vector6d way = trusted_->twist.value_or(Vector6d::Zero()) * time_s;
  Vector6d variance = trusted_->twist_variance * time_s * time_s;
  const double growth_s3 =
      time_s * time_s * time_s / 3.0;  // white noise on the acceleration, integrated twice
  variance.head<3>().array() += params_.acceleration_density * growth_s3;
  variance.tail<3>().array() += params_.angular_acceleration_density * growth_s3;
  Eigen::Isometry3d held = Eigen::Isometry3d::Identity();  // what the IMU saw after the coasting
  if (const auto turn = imu_.increment(trusted_->time_s, times.left_s)) {
    const Eigen::Vector3d angle = logRotation(turn->R_current_previous);
    way.tail<3>() = angle * time_s / lost_s;
    held.linear() = expRotation(angle - way.tail<3>());
    variance.tail<3>().setConstant(turn->sigma_rad * turn->sigma_rad);
    coasted.turn_is_measured = true;
  }
  // A heading that is off on the way leads aside.
  variance.head<3>().array() += way.head<3>().squaredNorm() * variance.tail<3>().maxCoeff() / 3.0;
  coasted.T_camera_world = held * expMotion(way) * trusted_->T_camera_world;
  coasted.covariance = variance.asDiagonal();
  return coasted;
}

bool MotionModel::expects(const Eigen::Isometry3d& T_camera_world, const Matrix6d& covariance,
                          const FrameTimes& times, double coasting_s) const {
  constexpr double kSigmas = 4.5;  // 99.7 % of six coordinates
  const Coasted coasted = this->coasted(times, coasting_s);
  if (!coasted.velocity_is_known) return false;
  const Vector6d difference = logMotion(T_camera_world * coasted.T_camera_world.inverse());
  return difference.dot((coasted.covariance + covariance).ldlt().solve(difference)) < kSigmas * kSigmas;
}

void MotionModel::trustPrevious() {
  Trusted trusted{previous_times_.left_s, previous_view_.T_camera_world, std::nullopt, Vector6d::Zero()};
  if (previous_interval_s_ > 0.0) {
    trusted.twist = Vector6d(logMotion(T_previous_before_) / previous_interval_s_);
    // The mean over the interval, by two poses; the velocity at its end is another one.
    const double interval_s = previous_interval_s_;
    trusted.twist_variance = 2.0 * pose_variance_ / (interval_s * interval_s);
    trusted.twist_variance.head<3>().array() += params_.acceleration_density * interval_s / 3.0;
    trusted.twist_variance.tail<3>().array() += params_.angular_acceleration_density * interval_s / 3.0;
  }
  trusted_ = trusted;
}

bool MotionModel::exceedsAcceleration(const Eigen::Isometry3d& T_current_previous, double interval_s) const {
  constexpr double kSigmas = 5.0;
  if (previous_interval_s_ == 0.0) return false;
  const Vector6d change =
      logMotion(T_current_previous) / interval_s - logMotion(T_previous_before_) / previous_interval_s_;
  const double time_s = 0.5 * (interval_s + previous_interval_s_);
  return change.head<3>().norm() > kSigmas * std::sqrt(params_.acceleration_density * time_s);
}

WindowFrame MotionModel::windowFrame(const vision::StereoView& view, const MotionPrior& prior) {
  WindowFrame frame;
  frame.view = view;
  frame.has_time_offset = prior.right_time_offset_s != 0.0;
  if (!frame.has_time_offset) return frame;
  frame.T_late_expected = expMotion(prior.twistAt(view) * prior.right_time_offset_s);
  frame.late_sigma = prior.lateSigma();
  if (prior.R_late_camera) frame.T_late_expected.linear() = *prior.R_late_camera;
  return frame;
}

void MotionModel::smoothTimeOffset(const FrameTimes& times, const vision::StereoView& current,
                                   WindowFrame& previous) const {
  const double offset_s = previous_times_.rightOffset_s();
  if (offset_s == 0.0) return;
  const double after_s = times.left_s - previous_times_.left_s;
  const Eigen::Isometry3d T_current_previous =
      current.T_camera_world * previous.view.T_camera_world.inverse();
  const Eigen::Matrix3d R_expected = previous.T_late_expected.linear();
  const Eigen::Vector3d rotation_sigma = previous.late_sigma.tail<3>();
  previous.T_late_expected = previous_interval_s_ > 0.0
                                 ? interpolatedMotion(T_current_previous, after_s, T_previous_before_,
                                                      previous_interval_s_, offset_s)
                                 : expMotion(logMotion(T_current_previous) * offset_s / after_s);
  // Midway between two known poses, under white acceleration.
  const double spread = std::sqrt(after_s * after_s * after_s / 48.0);
  previous.late_sigma.head<3>().setConstant(std::sqrt(params_.acceleration_density) * spread);
  previous.late_sigma.tail<3>().setConstant(std::sqrt(params_.angular_acceleration_density) * spread);
  if (imu_.increment(previous_times_.left_s, previous_times_.right_s)) {
    previous.T_late_expected.linear() = R_expected;
    previous.late_sigma.tail<3>() = rotation_sigma;
  }
}

void MotionModel::update(const FrameTimes& times, const MotionPrior& prior, const vision::StereoView& view,
                         const Matrix6d& covariance) {
  const Eigen::Isometry3d T_current_previous = view.T_camera_world * prior.T_previous_world.inverse();
  if (prior.R_current_previous) {
    const double rotation_variance = covariance.bottomRightCorner<3, 3>().trace() / 3.0;
    imu_.learn(previous_times_.left_s, times.left_s, T_current_previous.linear(),
               std::sqrt(rotation_variance));
  }
  if (times.rightOffset_s() != 0.0) {
    twist_ = Vector6d(logMotion(view.T_late_camera) / times.rightOffset_s());
  } else {
    twist_ = extrapolatedTwist(T_current_previous, prior.interval_s, std::nullopt);
  }
  T_previous_before_ = T_current_previous;
  previous_interval_s_ = prior.interval_s;
  previous_times_ = times;
  previous_view_ = view;
  pose_variance_ = covariance.diagonal();
}

}  // namespace stereo_nav::odometry
