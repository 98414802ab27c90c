#include "sensors/imu/allan_deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stereo_nav::imu {

std::vector<AllanPoint> allanDeviation(const std::vector<double>& samples, double period_s) {
  std::vector<double> integral(samples.size() + 1, 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) integral[i + 1] = integral[i] + samples[i] * period_s;

  std::vector<AllanPoint> points;
  for (std::size_t m = 1; m <= samples.size() / 9; m = std::max(m + 1, m * 6 / 5)) {
    const double tau_s = static_cast<double>(m) * period_s;
    double sum = 0.0;
    const std::size_t count = integral.size() - 2 * m;
    for (std::size_t i = 0; i < count; ++i) {
      const double second_difference = integral[i + 2 * m] - 2.0 * integral[i + m] + integral[i];
      sum += second_difference * second_difference;
    }
    points.push_back({tau_s, std::sqrt(sum / (2.0 * tau_s * tau_s * static_cast<double>(count)))});
  }
  return points;
}

double noiseDensity(const std::vector<AllanPoint>& points) {
  double sum = 0.0;
  int count = 0;
  for (const AllanPoint& point : points) {
    if (point.tau_s > 1.0) continue;
    sum += point.deviation * std::sqrt(point.tau_s);
    ++count;
  }
  return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

double biasInstability(const std::vector<AllanPoint>& points) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const AllanPoint& point : points) lowest = std::min(lowest, point.deviation);
  constexpr double kFlatPart = 0.664;  // sqrt(2 ln 2 / pi)
  return points.empty() ? std::numeric_limits<double>::quiet_NaN() : lowest / kFlatPart;
}

}  // namespace stereo_nav::imu
