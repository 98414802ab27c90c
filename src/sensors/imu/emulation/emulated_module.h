#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "sensors/imu/emulation/motion.h"
#include "sensors/imu/frame_decoder.h"

namespace stereo_nav::imu {

/// The errors of the module. By default it has none.
struct ModuleErrors {
  double angle_noise_deg = 0.0;       ///< standard deviation of each angle
  double angle_resolution_deg = 0.0;  ///< angles are multiples of this; 0: as the float has them
  double yaw_drift_deg_s = 0.0;       ///< the thesis' module: 2.9 degrees in 600 s
  Eigen::Vector3d gyro_bias = Eigen::Vector3d::Zero();             ///< rad/s
  double gyro_noise_rad_s = 0.0;                                   ///< standard deviation of a sample
  Eigen::Vector3d accelerometer_offset = Eigen::Vector3d::Zero();  ///< m/s^2
  Eigen::Vector3d accelerometer_gain = Eigen::Vector3d::Ones();
  double accelerometer_noise_m_s2 = 0.0;  ///< standard deviation of a sample
};

/// Turns motion into the frames that a module would send. Deterministic for a seed.
class EmulatedModule {
 public:
  EmulatedModule(Protocol protocol, AngleOrder order, bool magnetometer, const ModuleErrors& errors,
                 unsigned seed)
      : protocol_(protocol), order_(order), magnetometer_(magnetometer), errors_(errors), random_(seed) {}

  /// The bytes of the frame for the state at `time_s` of the module's clock.
  std::vector<std::uint8_t> frame(const MotionState& state, double time_s);
  /// The angles that the last angle frame carried.
  const ModuleAngles& lastAngles() const { return last_angles_; }

 private:
  std::vector<std::uint8_t> angleFrame(const MotionState& state, double time_s);
  RawMeasurement measure(const MotionState& state, double time_s);
  std::vector<std::uint8_t> rawFrame(const MotionState& state, double time_s);
  std::vector<std::uint8_t> phoneFrame(const MotionState& state, double time_s);
  double noise(double stddev);
  Eigen::Vector3d noiseVector(double stddev);

  Protocol protocol_;
  AngleOrder order_;
  bool magnetometer_;
  ModuleErrors errors_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  ModuleAngles last_angles_;
  std::uint16_t sequence_ = 0;
};

}  // namespace stereo_nav::imu
