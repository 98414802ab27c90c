#include "mapping/loop/descriptor_matching.h"

#include <algorithm>

namespace stereo_nav::mapping {

int cornerDistance(const DescribedView& a, std::size_t corner_a, const DescribedView& b,
                   std::size_t corner_b) {
  int smallest = vision::kDescriptorBits;
  for (std::size_t i = corner_a; i < a.descriptors.size(); i += a.corners) {
    for (std::size_t j = corner_b; j < b.descriptors.size(); j += b.corners)
      smallest = std::min(smallest, vision::hammingDistance(a.descriptors[i], b.descriptors[j]));
  }
  return smallest;
}

std::vector<CornerMatch> mutualMatches(const DescribedView& query, const DescribedView& place,
                                       int max_distance) {
  struct Best {
    std::size_t corner = 0;
    int distance = vision::kDescriptorBits + 1;
  };
  std::vector<Best> of_query(query.corners), of_place(place.corners);
  for (std::size_t q = 0; q < query.corners; ++q) {
    for (std::size_t p = 0; p < place.corners; ++p) {
      const int distance = cornerDistance(query, q, place, p);
      if (distance < of_query[q].distance) of_query[q] = {p, distance};
      if (distance < of_place[p].distance) of_place[p] = {q, distance};
    }
  }
  std::vector<CornerMatch> matches;
  for (std::size_t q = 0; q < query.corners; ++q) {
    const Best& best = of_query[q];
    if (best.distance <= max_distance && of_place[best.corner].corner == q)
      matches.push_back({q, best.corner, best.distance});
  }
  return matches;
}

}  // namespace stereo_nav::mapping
