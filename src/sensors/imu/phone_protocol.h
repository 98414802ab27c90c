#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "stereo_nav/sensors/imu/raw_protocol.h"

namespace stereo_nav::imu {

/// One datagram of a phone. `device_time_us` and `sequence` of the measurement are not used.
struct PhoneSample {
  double time_s = 0.0;  ///< of the phone's clock
  /// In the axes of a phone that lies flat on the robot, screen upwards and upper edge forward: x forward, y
  /// left, z up.
  RawMeasurement measurement;
};

/// The text that the Android app "Sensorstream IMU+GPS" sends in each datagram, numbers separated by commas:
///
///     TIME, ID, X, Y, Z, ID, X, Y, Z, ...
///
/// TIME in seconds; ID 3: accelerometer (m/s^2), 4: gyroscope (rad/s), 5: magnetometer (uT), in Android's
/// axes (x to the right of the screen, y to its upper edge, z out of it). Of the others 8, 85 and 86 have one
/// value, all else three; they are skipped.
///
/// Returns nothing where a number is damaged or no sensor measures it, or where the datagram has no gyroscope
/// or no accelerometer.
std::optional<PhoneSample> parsePhoneText(const std::uint8_t* data, std::size_t size);

/// What the app would send.
std::string phoneText(const PhoneSample& sample);

}  // namespace stereo_nav::imu
