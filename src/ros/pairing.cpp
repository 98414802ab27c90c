#include "stereo_nav/ros/pairing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/statistics.h"

namespace stereo_nav::ros_io {
namespace {

std::optional<std::size_t> find(const std::vector<ros::Time>& stamps, const ros::Time& stamp) {
  const auto position = std::lower_bound(stamps.begin(), stamps.end(), stamp);
  if (position == stamps.end() || *position != stamp) return std::nullopt;
  return static_cast<std::size_t>(position - stamps.begin());
}

std::optional<std::size_t> findEither(const std::vector<ros::Time>& stamps, const ros::Time& own,
                                      const ros::Time& common) {
  const auto index = find(stamps, own);
  return index ? index : find(stamps, common);
}

std::vector<StampPair> pairBySync(const std::vector<ros::Time>& left, const std::vector<ros::Time>& right,
                                  const std::vector<StereoSync>& sync) {
  std::vector<StampPair> pairs;
  std::vector<bool> left_used(left.size(), false);
  std::vector<bool> right_used(right.size(), false);
  for (const StereoSync& message : sync) {
    const auto l = findEither(left, message.left_stamp, message.header.stamp);
    const auto r = findEither(right, message.right_stamp, message.header.stamp);
    if (!l || !r || left_used[*l] || right_used[*r]) continue;
    left_used[*l] = true;
    right_used[*r] = true;
    pairs.push_back(
        {*l, *r, message.left_stamp.toSec(), message.right_stamp.toSec(), message.rolling_shutter_s});
  }
  return pairs;
}

/// Infinite for fewer than two stamps: then any distance in time is accepted.
double medianPeriod_s(const std::vector<ros::Time>& stamps) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < stamps.size(); ++i) periods.push_back((stamps[i] - stamps[i - 1]).toSec());
  if (periods.empty()) return std::numeric_limits<double>::infinity();
  return upperMedian(periods);
}

struct Candidate {
  std::size_t left;
  std::size_t right;
  double offset_s;
};

std::vector<StampPair> pairByNearest(const std::vector<ros::Time>& left,
                                     const std::vector<ros::Time>& right) {
  // Stamps are whole nanoseconds: one more lets a time offset of exactly half a period pair.
  const double max_time_offset_s = 0.5 * medianPeriod_s(left) + 1e-9;
  std::vector<Candidate> candidates;
  for (std::size_t l = 0; l < left.size(); ++l) {
    const auto after = std::lower_bound(right.begin(), right.end(), left[l]);
    const auto r = static_cast<std::size_t>(after - right.begin());
    for (const std::size_t neighbour : {r, r - 1}) {
      if (neighbour >= right.size()) continue;  // also true of r - 1 where r = 0
      const double offset_s = std::abs((right[neighbour] - left[l]).toSec());
      if (offset_s <= max_time_offset_s) candidates.push_back({l, neighbour, offset_s});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.offset_s < b.offset_s; });
  std::vector<StampPair> pairs;
  std::vector<bool> left_used(left.size(), false);
  std::vector<bool> right_used(right.size(), false);
  for (const Candidate& candidate : candidates) {
    if (left_used[candidate.left] || right_used[candidate.right]) continue;
    left_used[candidate.left] = true;
    right_used[candidate.right] = true;
    pairs.push_back(
        {candidate.left, candidate.right, left[candidate.left].toSec(), right[candidate.right].toSec(), 0.0});
  }
  return pairs;
}

}  // namespace

std::vector<StampPair> pairStamps(const std::vector<ros::Time>& left, const std::vector<ros::Time>& right,
                                  const std::vector<StereoSync>& sync) {
  std::vector<StampPair> pairs = sync.empty() ? pairByNearest(left, right) : pairBySync(left, right, sync);
  std::sort(pairs.begin(), pairs.end(),
            [](const StampPair& a, const StampPair& b) { return a.left < b.left; });
  return pairs;
}

}  // namespace stereo_nav::ros_io
