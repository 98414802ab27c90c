#include "sensors/imu/emulation/emulated_module.h"

#include <cmath>

#include "core/angles.h"
#include "sensors/imu/phone_protocol.h"

namespace stereo_nav::imu {
namespace {

/// Points north (y) and down, as in central Europe.
const Eigen::Vector3d kField_uT(0.0, 20.0, -44.0);

double quantised(double value, double resolution) {
  return resolution > 0.0 ? std::round(value / resolution) * resolution : value;
}

}  // namespace

std::vector<std::uint8_t> EmulatedModule::frame(const MotionState& state, double time_s) {
  if (protocol_ == Protocol::kAngles) return angleFrame(state, time_s);
  return protocol_ == Protocol::kRaw ? rawFrame(state, time_s) : phoneFrame(state, time_s);
}

std::vector<std::uint8_t> EmulatedModule::angleFrame(const MotionState& state, double time_s) {
  ModuleAngles angles = moduleFromOrientation(state.q_world_imu);
  angles.yaw_deg = wrapDegrees(angles.yaw_deg + errors_.yaw_drift_deg_s * time_s);
  for (double* angle : {&angles.yaw_deg, &angles.pitch_deg, &angles.roll_deg}) {
    *angle = quantised(wrapDegrees(*angle + noise(errors_.angle_noise_deg)), errors_.angle_resolution_deg);
  }
  last_angles_ = angles;
  std::vector<std::uint8_t> bytes(AngleFramer::kFrameBytes);
  encodeAngleFrame(angles, order_, bytes.data());
  return bytes;
}

RawMeasurement EmulatedModule::measure(const MotionState& state, double time_s) {
  RawMeasurement measured;
  measured.sequence = sequence_++;
  measured.device_time_us =
      static_cast<std::uint32_t>(static_cast<std::uint64_t>(std::llround(time_s * 1e6)));
  measured.angular_velocity =
      state.angular_velocity + errors_.gyro_bias + noiseVector(errors_.gyro_noise_rad_s);
  measured.linear_acceleration = state.linear_acceleration.cwiseProduct(errors_.accelerometer_gain) +
                                 errors_.accelerometer_offset + noiseVector(errors_.accelerometer_noise_m_s2);
  if (magnetometer_) measured.magnetic_field = state.q_world_imu.conjugate() * kField_uT;
  return measured;
}

std::vector<std::uint8_t> EmulatedModule::rawFrame(const MotionState& state, double time_s) {
  std::vector<std::uint8_t> bytes(raw_protocol::kMaxFrameBytes);
  bytes.resize(raw_protocol::encode(measure(state, time_s), bytes.data()));
  return bytes;
}

std::vector<std::uint8_t> EmulatedModule::phoneFrame(const MotionState& state, double time_s) {
  constexpr double kSwitchedOn_s = 4321.0;  // before the stream began
  const std::string text = phoneText({kSwitchedOn_s + time_s, measure(state, time_s)});
  return {text.begin(), text.end()};
}

double EmulatedModule::noise(double stddev) {
  return stddev > 0.0 ? stddev * normal_(random_) : 0.0;
}

Eigen::Vector3d EmulatedModule::noiseVector(double stddev) {
  const double x = noise(stddev);
  const double y = noise(stddev);
  const double z = noise(stddev);
  return {x, y, z};
}

}  // namespace stereo_nav::imu
