#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace stereo_nav {

/// Value below which the given share (0 to 1) of the samples lies, interpolated linearly between the two
/// samples around it; 0.5 is the median. NaN without samples.
double quantile(std::vector<double> samples, double share);

/// The sample in the middle; of an even number the larger one of the two in the middle. Unlike quantile(0.5)
/// it is always one of the samples and costs linear time, which suits thresholds and robust scales. Needs at
/// least one sample. The order of the samples changes.
template <class Number>
Number upperMedian(std::vector<Number>& samples) {
  if (samples.empty()) throw std::invalid_argument("upperMedian() needs at least one sample");
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  std::nth_element(samples.begin(), middle, samples.end());
  return *middle;
}

/// Square that the length of a normalised error of `dimensions` (1 to 6) exceeds in (1 - share) of all cases:
/// the quantile of the chi-square distribution with that many degrees of freedom. `share` must lie between 0
/// and 1, both excluded; the result is exact to 1e-9.
double chiSquareQuantile(int dimensions, double share);

}  // namespace stereo_nav
