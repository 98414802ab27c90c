#include "core/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "core/angles.h"

namespace stereo_nav {
namespace {

/// Share of the chi-square distribution below `x`, by the recurrence over the degrees of freedom, two at a
/// time (Abramowitz and Stegun, "Handbook of Mathematical Functions", 26.4.4 and 26.4.5).
double chiSquareShare(int dimensions, double x) {
  const bool odd = dimensions % 2 == 1;
  double share = odd ? std::erf(std::sqrt(0.5 * x)) : 1.0 - std::exp(-0.5 * x);
  double term = odd ? std::sqrt(2.0 * x / kPi) * std::exp(-0.5 * x) : 0.5 * x * std::exp(-0.5 * x);
  for (int next = odd ? 3 : 4; next <= dimensions; next += 2) {
    share -= term;
    term *= x / next;
  }
  return share;
}

}  // namespace

double quantile(std::vector<double> samples, double share) {
  if (samples.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(samples.begin(), samples.end());
  const double position = share * static_cast<double>(samples.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, samples.size() - 1);
  return samples[below] + (position - static_cast<double>(below)) * (samples[above] - samples[below]);
}

double chiSquareQuantile(int dimensions, double share) {
  if (dimensions < 1 || dimensions > 6 || !(share > 0.0) || !(share < 1.0)) {
    throw std::invalid_argument("chiSquareQuantile() needs 1 to 6 dimensions and a share between 0 and 1");
  }
  double low = 0.0, high = 1.0;
  while (chiSquareShare(dimensions, high) < share && high < 1024.0) high *= 2.0;
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (chiSquareShare(dimensions, middle) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace stereo_nav
