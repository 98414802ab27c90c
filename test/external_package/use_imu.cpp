// A frame of the raw protocol written and read again, and the attitude of a module at rest.
#include <stereo_nav/sensors/imu/calibration.h>

#include "expect.h"

int main() {
  namespace imu = stereo_nav::imu;
  imu::RawMeasurement sent;
  sent.angular_velocity.setZero();
  sent.linear_acceleration << 0.0, 0.0, 9.80665;
  std::uint8_t bytes[imu::raw_protocol::kMaxFrameBytes];
  const std::size_t length = imu::raw_protocol::encode(sent, bytes);
  imu::RawParser parser;
  std::optional<imu::RawFrame> frame;
  for (std::size_t i = 0; i < length; ++i) frame = parser.push(bytes[i]);
  expect(frame.has_value(), "the frame is read");

  const auto filter = imu::makeAttitudeFilter({});
  const imu::ImuCalibration calibration;
  for (int i = 0; i < 10; ++i) filter->update(calibration.apply(frame->measurement, 0.01 * i));
  expect(filter->initialised(), "the filter has an attitude");
  expect(filter->q_world_imu().angularDistance(Eigen::Quaterniond::Identity()) < 1e-6, "the module is level");
}
