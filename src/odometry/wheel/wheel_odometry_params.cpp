#include "odometry/wheel/wheel_odometry_params.h"

#include <cmath>

#include "kinematics/drive_file.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::odometry {

double WheelOdometryParams::readingVariance_m2(const kinematics::WheelParams& wheel) const {
  return std::pow(pulse_sigma * wheel.metresPerPulse(), 2);
}

double WheelOdometryParams::slipVariance_m2(double distance_m) const {
  return slip_sigma_m * slip_sigma_m * std::abs(distance_m);
}

void WheelOdometryParams::describe(ParameterVisitor& visitor) {
  visitor.integer("counter_bits", counter_bits, {8, 63}, "bits",
                  "width of the pulse counters, after which they wrap");
  visitor.real("pulse_sigma", pulse_sigma, {1e-3, 100.0}, "pulses",
               "standard deviation of a counter's reading; 0.29 is that of rounding");
  visitor.real("slip_sigma_m", slip_sigma_m, {0.0, 1.0}, "m",
               "standard deviation of what a wheel slips on 1 m of its way; grows with the root of the way");
  visitor.real("scale_sigma", scale_sigma, {0.0, 1.0}, "",
               "relative standard deviation of each radius; an error that stays the same on the whole way");
  visitor.real("yaw_sigma_rad", yaw_sigma_rad, {1e-6, 1.0}, "rad",
               "standard deviation of the IMU's yaw increment in 1 s; grows with the root of the time");
  visitor.real("yaw_drift_sigma_rad_per_s", yaw_drift_sigma_rad_per_s, {0.0, 1.0}, "rad/s",
               "standard deviation of the constant drift of the IMU's yaw");
  visitor.real("speed_window_s", speed_window_s, {1e-3, 10.0}, "s", "time over which the speed is taken");
  visitor.flag(
      "as_published", as_published,
      "turn each interval's motion by the yaw at its start, as the swerve robot of 2024 does, instead of "
      "following the arc");
}

WheelOdometryParams loadWheelOdometry(const std::string& config_path, const RigFile& rig) {
  WheelOdometryParams params;
  if (!config_path.empty()) readParameters(loadYamlFile(config_path), config_path, params);
  readParameters(rig.section(rig_sections::kWheelOdometry), rig.sectionName(rig_sections::kWheelOdometry),
                 params);
  params.drive = kinematics::readDrive(rig);
  return params;
}

}  // namespace stereo_nav::odometry
