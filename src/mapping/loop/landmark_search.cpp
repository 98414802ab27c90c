#include "mapping/loop/landmark_search.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace stereo_nav::mapping {
namespace {

/// The corners of the query, and which of them are taken.
class QueryCorners {
 public:
  QueryCorners(const LandmarkSearchParams& params, const vision::Keyframe& query)
      : params_(params), query_(query), taken_(query.corners.size(), false) {}

  const vision::KeyframeCorner& take(std::size_t corner) {
    taken_[corner] = true;
    return query_.corners[corner];
  }

  /// The free corner most like `corner` of `view` within the radius of `px`; the number of corners if none.
  std::size_t nearest(const Eigen::Vector2d& px, const DescribedView& view, std::size_t corner) const {
    const DescribedView own{query_.descriptors, query_.corners.size()};
    std::size_t best = query_.corners.size();
    int smallest = params_.max_distance + 1;
    for (std::size_t i = 0; i < query_.corners.size(); ++i) {
      if (taken_[i] || (query_.corners[i].px - px).norm() > params_.radius_px) continue;
      const int distance = cornerDistance(own, i, view, corner);
      if (distance >= smallest) continue;
      smallest = distance;
      best = i;
    }
    return best;
  }
  bool has(std::size_t corner) const { return corner < query_.corners.size(); }

 private:
  const LandmarkSearchParams& params_;
  const vision::Keyframe& query_;
  std::vector<bool> taken_;
};

/// The place, then its neighbours among the first `keyframes`, the nearest ones first.
std::vector<std::size_t> aroundPlace(const LandmarkSearchParams& params, std::size_t keyframes,
                                     std::size_t place) {
  std::vector<std::size_t> positions{place};
  for (std::size_t step = 1; step <= static_cast<std::size_t>(params.neighbours); ++step) {
    if (place >= step) positions.push_back(place - step);
    if (place + step < keyframes) positions.push_back(place + step);
  }
  return positions;
}

}  // namespace

void LandmarkSearchParams::describe(ParameterVisitor& visitor) {
  visitor.integer("neighbours", neighbours, {0, 100}, "",
                  "keyframes before and after a place whose landmarks are looked for, too");
  visitor.real("radius_px", radius_px, {0.5, 100.0}, "px", "distance within which they are looked for");
  visitor.integer("max_distance", max_distance, {1, 256}, "",
                  "bits by which the descriptors of one landmark differ at most");
}

std::vector<LandmarkMatch> searchNeighbours(const LandmarkSearchParams& params,
                                            const vision::StereoCalibration& calibration,
                                            const KeyframeChain& chain, std::size_t place,
                                            const vision::Keyframe& query,
                                            const Eigen::Isometry3d& T_query_place,
                                            const std::vector<CornerMatch>& matches) {
  std::vector<LandmarkMatch> found;
  std::unordered_set<std::uint64_t> known;
  QueryCorners corners(params, query);
  for (const CornerMatch& match : matches) {
    LandmarkMatch landmark;
    setPoint(calibration, chain[place].corners[match.place], landmark);
    landmark.seen = corners.take(match.query);
    found.push_back(landmark);
    known.insert(chain[place].corners[match.place].landmark_id);
  }
  for (const std::size_t position : aroundPlace(params, chain.size() - 1, place)) {
    const auto pose = chain.relative(place, position);
    if (!pose) continue;
    const vision::Keyframe& keyframe = chain[position];
    const DescribedView view{keyframe.descriptors, keyframe.corners.size()};
    const Eigen::Matrix3d R_place_keyframe = pose->T.linear();
    for (std::size_t i = 0; i < keyframe.corners.size(); ++i) {
      const vision::KeyframeCorner& corner = keyframe.corners[i];
      if (!corner.hasDepth() || (corner.landmark_id != 0 && known.count(corner.landmark_id) != 0)) continue;
      LandmarkMatch landmark;
      setPoint(calibration, corner, landmark);
      landmark.p_place = pose->T * landmark.p_place;
      landmark.covariance = R_place_keyframe * landmark.covariance * R_place_keyframe.transpose();
      const Eigen::Vector3d p_query = T_query_place * landmark.p_place;
      if (p_query.z() <= 0.0) continue;
      const std::size_t seen = corners.nearest(measurementOf(calibration, p_query).head<2>(), view, i);
      if (!corners.has(seen)) continue;
      landmark.seen = corners.take(seen);
      found.push_back(landmark);
      known.insert(corner.landmark_id);
    }
  }
  return found;
}

}  // namespace stereo_nav::mapping
