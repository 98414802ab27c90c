#include "sensors/imu/drift.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/angles.h"

namespace stereo_nav::imu {
namespace {

constexpr double kEnd_s = 1.0;

double meanBetween(const std::vector<double>& times_s, const std::vector<double>& values, double from_s,
                   double to_s) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (times_s[i] < from_s || times_s[i] > to_s) continue;
    sum += values[i];
    ++count;
  }
  return sum / count;
}

AngleDrift driftOf(const std::vector<double>& times_s, const std::vector<double>& angles_deg) {
  std::vector<double> unwrapped = angles_deg;
  for (std::size_t i = 1; i < unwrapped.size(); ++i) {
    unwrapped[i] = unwrapped[i - 1] + wrapDegrees(angles_deg[i] - angles_deg[i - 1]);
  }
  const double first = meanBetween(times_s, unwrapped, times_s.front(), times_s.front() + kEnd_s);
  const double last = meanBetween(times_s, unwrapped, times_s.back() - kEnd_s, times_s.back());

  const auto count = static_cast<double>(times_s.size());
  double mean_t = 0.0, mean_a = 0.0;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    mean_t += times_s[i] / count;
    mean_a += unwrapped[i] / count;
  }
  double tt = 0.0, ta = 0.0, aa = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    const double t = times_s[i] - mean_t;
    const double a = unwrapped[i] - mean_a;
    tt += t * t;
    ta += t * a;
    aa += a * a;
    largest = std::max(largest, std::abs(unwrapped[i] - first));
  }
  const double slope = ta / tt;
  return {last - first, slope * 60.0, std::sqrt(std::max(0.0, aa - slope * ta) / count), largest};
}

}  // namespace

DriftReport measureDrift(const std::vector<AngleSample>& samples) {
  if (samples.empty() || samples.back().time_s - samples.front().time_s <= 2.0 * kEnd_s) {
    throw std::invalid_argument("drift needs measurements over more than two seconds");
  }
  std::vector<double> times_s, yaw, pitch, roll;
  for (const AngleSample& sample : samples) {
    times_s.push_back(sample.time_s - samples.front().time_s);
    yaw.push_back(sample.angles.yaw_deg);
    pitch.push_back(sample.angles.pitch_deg);
    roll.push_back(sample.angles.roll_deg);
  }
  return {times_s.back(), driftOf(times_s, yaw), driftOf(times_s, pitch), driftOf(times_s, roll)};
}

}  // namespace stereo_nav::imu
