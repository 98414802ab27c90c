#pragma once

#include <cstddef>
#include <vector>

#include "vision/descriptor.h"

namespace stereo_nav::mapping {

/// Corners of two views that are each other's most similar ones.
struct CornerMatch {
  std::size_t query;
  std::size_t place;
  int distance;  ///< bits that differ
};

/// Descriptors of one view: all corners at the first scale, then at the second, and so on (vision::Keyframe).
struct DescribedView {
  const std::vector<vision::Descriptor>& descriptors;
  std::size_t corners;
};

/// Smallest distance between two corners, over all pairs of their scales.
int cornerDistance(const DescribedView& a, std::size_t corner_a, const DescribedView& b,
                   std::size_t corner_b);

/// Mutual matches with at most `max_distance` bits that differ, in order of the query's corners.
std::vector<CornerMatch> mutualMatches(const DescribedView& query, const DescribedView& place,
                                       int max_distance);

}  // namespace stereo_nav::mapping
