#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace stereo_nav {

/// Value below which the given share (0 to 1) of the samples lies, interpolated linearly between the two
/// nearest samples; a share of 0.5 gives the median. NaN without samples.
double quantile(std::vector<double> samples, double share);

/// The middle sample, or the larger of the two middle ones when their number is even. Unlike quantile(0.5) it
/// is always one of the samples and takes linear time, which suits thresholds and robust scales. Needs at
/// least one sample. Changes the order of the samples.
template <class Number>
Number upperMedian(std::vector<Number>& samples) {
  if (samples.empty()) throw std::invalid_argument("upperMedian() needs at least one sample");
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

/// Quantile of the chi-square distribution with `dimensions` (1 to 6) degrees of freedom: the squared length
/// of a normalised error of that many dimensions exceeds it in (1 - share) of all cases. `share` must lie
/// between 0 and 1, both excluded; the result is exact to 1e-9. For gates and for tests of
/// consistency.
double chiSquareQuantile(int dimensions, double share);

}  // namespace stereo_nav
