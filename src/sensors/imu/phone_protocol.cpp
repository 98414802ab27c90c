#include "sensors/imu/phone_protocol.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace stereo_nav::imu {
namespace {

using Eigen::Vector3d;

constexpr double kAccelerometer = 3.0, kGyroscope = 4.0, kMagnetometer = 5.0;
constexpr std::size_t kMaxNumbers = 100;
/// A clock in seconds, be it since the phone was switched on or since 1970.
constexpr double kMaxTime_s = 1e11;

bool hasOneValue(double id) {
  return id == 8.0 || id == 85.0 || id == 86.0;
}

/// Empty where anything but finite decimal numbers between commas stands there.
std::vector<double> numbersOf(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  while (numbers.size() < kMaxNumbers) {
    at += std::strspn(at, " ");
    const std::size_t length = std::strspn(at, "0123456789+-.eE");
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (length == 0 || end != at + length || !std::isfinite(number)) return {};
    numbers.push_back(number);
    at = end + std::strspn(end, " \r\n");
    if (*at == '\0') return at == text.c_str() + text.size() ? numbers : std::vector<double>();
    if (*at++ != ',') return {};
  }
  return {};
}

Vector3d fromAndroid(const Vector3d& v) {
  return {v.y(), -v.x(), v.z()};
}

Vector3d toAndroid(const Vector3d& v) {
  return {-v.y(), v.x(), v.z()};
}

void appendVector(std::string& text, int id, const Vector3d& flat) {
  const Vector3d v = toAndroid(flat);
  std::array<char, 128> buffer{};
  std::snprintf(buffer.data(), buffer.size(), ", %d, %7.4f,%8.4f,%8.4f", id, v.x(), v.y(), v.z());
  text += buffer.data();
}

}  // namespace

std::optional<PhoneSample> parsePhoneText(const std::uint8_t* data, std::size_t size) {
  const std::vector<double> numbers = numbersOf(std::string(data, data + size));
  if (numbers.empty() || numbers[0] < 0.0 || numbers[0] > kMaxTime_s) return std::nullopt;
  PhoneSample sample;
  sample.time_s = numbers[0];
  bool accelerometer = false, gyroscope = false;
  for (std::size_t i = 1; i < numbers.size();) {
    const double id = numbers[i++];
    const std::size_t count = hasOneValue(id) ? 1 : 3;
    if (i + count > numbers.size()) return std::nullopt;
    if (count == 3) {
      const Vector3d v = fromAndroid({numbers[i], numbers[i + 1], numbers[i + 2]});
      if (id == kAccelerometer) sample.measurement.linear_acceleration = v;
      if (id == kGyroscope) sample.measurement.angular_velocity = v;
      if (id == kMagnetometer) sample.measurement.magnetic_field = v;
      accelerometer = accelerometer || id == kAccelerometer;
      gyroscope = gyroscope || id == kGyroscope;
    }
    i += count;
  }
  if (!accelerometer || !gyroscope || !raw_protocol::possible(sample.measurement)) return std::nullopt;
  return sample;
}

std::string phoneText(const PhoneSample& sample) {
  std::array<char, 64> time{};
  std::snprintf(time.data(), time.size(), "%.5f", sample.time_s);
  std::string text = time.data();
  appendVector(text, 3, sample.measurement.linear_acceleration);
  appendVector(text, 4, sample.measurement.angular_velocity);
  if (sample.measurement.magnetic_field) appendVector(text, 5, *sample.measurement.magnetic_field);
  return text;
}

}  // namespace stereo_nav::imu
