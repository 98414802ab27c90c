#include "estimation/ekf/filter_params.h"

namespace stereo_nav::estimation {
namespace {

Eigen::Vector3d squared(double sigma) {
  return Eigen::Vector3d::Constant(sigma * sigma);
}

}  // namespace

void FilterParams::describe(ParameterVisitor& visitor) {
  visitor.real("gravitational_acceleration", gravity_m_s2, {9.0, 10.0}, "m/s^2",
               "length of the gravity that an accelerometer feels");
  visitor.flag(
      "smooth_lagged_data", rewind,
      "measurements that come late are put where they belong by rewinding the history; off: they are dropped");
  visitor.real("history_length", history_s, {0.0, 60.0}, "s", "how late a measurement may come");
  visitor.real("history_megabytes", history_megabytes, {0.1, 1000.0}, "MB", "most memory of the history");
  visitor.flag(
      "reset_on_time_jump", reset_on_time_jump,
      "when the clock is set back, begin anew at the initial state; off: go on from the present pose");
  visitor.flag("zero_velocity_updates", zero_velocity_updates,
               "hold velocity and turn rate at zero while every sensor says that the robot rests");
  visitor.real(
      "gate_share", gate_share, {0.9, 0.999999}, "",
      "share of good measurements that the gates let pass, where the file has no *_rejection_threshold");
  visitor.real("gyro_bias_sigma", gyro_bias_sigma_rad_s, {1e-6, 1.0}, "rad/s",
               "of a gyroscope's bias at the start");
  visitor.real("accelerometer_bias_sigma", accelerometer_bias_sigma_m_s2, {1e-6, 5.0}, "m/s^2",
               "of an accelerometer's bias at the start");
  visitor.real("wheel_scale_sigma", wheel_scale_sigma, {1e-6, 0.5}, "", "of the wheels' scales at the start");
  visitor.real("wheel_turn_per_way_sigma", wheel_turn_per_way_sigma_rad_m, {1e-6, 1.0}, "rad/m",
               "of the turn that the wheels do not show, as wheels of unequal radii make it, at the start");
  visitor.real("wheel_drift_sigma", wheel_drift_sigma, {1e-6, 0.5}, "",
               "of the way to the left for each metre ahead that the wheels do not show, at the start");
  visitor.real("acceleration_noise", acceleration_noise_m_s2, {1e-4, 100.0}, "m/s^2",
               "how much a velocity may change within a second by itself");
  visitor.real("turn_acceleration_noise", turn_acceleration_noise_rad_s2, {1e-4, 100.0}, "rad/s^2",
               "the same of a turn rate");
  visitor.real("jerk_noise", jerk_noise_m_s3, {1e-4, 100.0}, "m/s^3",
               "the same of an acceleration, where an accelerometer is used");
  visitor.real("gyro_bias_walk", gyro_bias_walk_rad_s2, {0.0, 0.1}, "rad/s^2",
               "how much a gyroscope's bias may change within a second");
  visitor.real("accelerometer_bias_walk", accelerometer_bias_walk_m_s3, {0.0, 1.0}, "m/s^3",
               "the same of an accelerometer's");
  visitor.real("wheel_scale_walk", wheel_scale_walk, {0.0, 0.1}, "1/s", "the same of the wheels' scales");
  visitor.real("default_position_sigma", defaults.position_m, {1e-6, 1e3}, "m",
               "of poses whose variance cannot be right");
  visitor.real("default_attitude_sigma", defaults.attitude_rad, {1e-6, 3.2}, "rad", "the same of attitudes");
  visitor.real("default_velocity_sigma", defaults.velocity_m_s, {1e-6, 1e3}, "m/s", "the same of velocities");
  visitor.real("default_turn_rate_sigma", defaults.turn_rate_rad_s, {1e-6, 1e3}, "rad/s",
               "the same of turn rates in a twist");
  visitor.real("default_gyro_sigma", defaults.gyro_rad_s, {1e-6, 1e3}, "rad/s", "the same of a gyroscope");
  visitor.real("default_acceleration_sigma", defaults.acceleration_m_s2, {1e-6, 1e3}, "m/s^2",
               "the same of an accelerometer");
}

ProcessNoise FilterParams::noise() const {
  ProcessNoise noise;
  noise.velocity = squared(acceleration_noise_m_s2);
  noise.rate = squared(turn_acceleration_noise_rad_s2);
  noise.acceleration = squared(jerk_noise_m_s3);
  noise.gyro_bias = squared(gyro_bias_walk_rad_s2);
  noise.accelerometer_bias = squared(accelerometer_bias_walk_m_s3);
  noise.wheel_scale.setConstant(wheel_scale_walk * wheel_scale_walk);
  if (!process_noise) return noise;
  noise.position = process_noise->segment<3>(0);
  noise.rotation = process_noise->segment<3>(3);
  // Those files are tuned for a filter without gates, which follows a sudden motion by force.
  noise.velocity = noise.velocity.cwiseMax(process_noise->segment<3>(6));
  noise.rate = noise.rate.cwiseMax(process_noise->segment<3>(9));
  noise.acceleration = noise.acceleration.cwiseMax(process_noise->segment<3>(12));
  return noise;
}

WheelScales FilterParams::scaleVariances() const {
  WheelScales sigmas;
  for (std::size_t i = 0; i < kScalePlaces.size(); ++i) {
    const ScalePlace place = kScalePlaces[i];
    sigmas[static_cast<Eigen::Index>(i)] = place.axis == place.of ? wheel_scale_sigma
                                           : place.axis == 2      ? wheel_turn_per_way_sigma_rad_m
                                                                  : wheel_drift_sigma;
  }
  return sigmas.cwiseAbs2();
}

}  // namespace stereo_nav::estimation
