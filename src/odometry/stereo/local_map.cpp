#include "odometry/stereo/local_map.h"

#include <algorithm>

namespace stereo_nav::odometry {
namespace {

bool isBefore(const Landmark& landmark, std::uint64_t id) {
  return landmark.id < id;
}

}  // namespace

void LocalMap::clear() {
  frames_.clear();
  landmarks_.clear();
}

void LocalMap::start(const WindowFrame& first) {
  clear();
  frames_.push_back(first);
}

const Landmark* LocalMap::find(std::uint64_t id) const {
  const auto place = std::lower_bound(landmarks_.begin(), landmarks_.end(), id, isBefore);
  return place != landmarks_.end() && place->id == id ? &*place : nullptr;
}

void LocalMap::addObservation(std::uint64_t id, const vision::StereoObservation& seen) {
  const auto place = std::lower_bound(landmarks_.begin(), landmarks_.end(), id, isBefore);
  place->views.push_back({static_cast<int>(frames_.size()) - 1, seen});
}

std::uint64_t LocalMap::addLandmark(Landmark landmark, const vision::StereoObservation& seen) {
  landmark.id = next_id_++;
  landmark.views.assign(1, {static_cast<int>(frames_.size()) - 1, seen});
  landmarks_.push_back(std::move(landmark));
  return landmarks_.back().id;
}

std::optional<Matrix6d> LocalMap::growth() const {
  auto covariance = optimizer_.newestCovariance(frames_, 0);
  if (covariance) *covariance /= static_cast<double>(frames_.size() - 1);
  return covariance;
}

std::optional<Matrix6d> LocalMap::noise() const {
  return optimizer_.newestCovariance(frames_, frames_.size() - 2);
}

void LocalMap::removeNewest() {
  for (Landmark& landmark : landmarks_) {
    if (!landmark.views.empty() && landmark.views.back().frame + 1 == static_cast<int>(frames_.size()))
      landmark.views.pop_back();
  }
  frames_.pop_back();
}

void LocalMap::keepNewest() {
  const int excess = static_cast<int>(frames_.size()) - most_keyframes_;
  if (excess <= 0) return;
  frames_.erase(frames_.begin(), frames_.begin() + excess);
  for (Landmark& landmark : landmarks_) {
    auto& views = landmark.views;
    views.erase(std::remove_if(views.begin(), views.end(),
                               [excess](const LandmarkView& view) { return view.frame < excess; }),
                views.end());
    for (LandmarkView& view : views) view.frame -= excess;
  }
}

void LocalMap::removeUnused(const std::vector<std::uint64_t>& followed) {
  landmarks_.erase(std::remove_if(landmarks_.begin(), landmarks_.end(),
                                  [&followed](const Landmark& landmark) {
                                    return landmark.views.size() < 2 &&
                                           !std::binary_search(followed.begin(), followed.end(), landmark.id);
                                  }),
                   landmarks_.end());
}

}  // namespace stereo_nav::odometry
