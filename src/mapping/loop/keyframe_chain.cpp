#include "mapping/loop/keyframe_chain.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace stereo_nav::mapping {
namespace {

Matrix6d carried(const Eigen::Isometry3d& T_a_b, const Matrix6d& covariance_b) {
  const Matrix6d carry = adjoint(T_a_b);
  return carry * covariance_b * carry.transpose();
}

void check(const vision::Keyframe& keyframe) {
  const bool fits = keyframe.corners.empty() ? keyframe.descriptors.empty()
                                             : !keyframe.descriptors.empty() &&
                                                   keyframe.descriptors.size() % keyframe.corners.size() == 0;
  if (fits) return;
  throw std::invalid_argument("keyframe " + std::to_string(keyframe.id) + " has " +
                              std::to_string(keyframe.descriptors.size()) + " descriptors of " +
                              std::to_string(keyframe.corners.size()) +
                              " corners: each corner needs one at every scale");
}

}  // namespace

void DriftParams::describe(ParameterVisitor& visitor) {
  visitor.real("share", share, {0.0, 1.0}, "",
               "standard deviation of the odometry's position besides its own covariance, as a share of the "
               "way: errors of the calibration");
  visitor.real("turn_rad_per_m", turn_rad_per_m, {0.0, 1.0}, "rad/m", "likewise of its attitude");
}

RelativePose composed(const RelativePose& a, const RelativePose& b) {
  return {a.T * b.T, carried(b.T.inverse(), a.covariance) + b.covariance};
}

RelativePose inverse(const RelativePose& pose) {
  return {pose.T.inverse(), carried(pose.T, pose.covariance)};
}

void KeyframeChain::add(vision::Keyframe keyframe) {
  check(keyframe);
  Link link;
  if (!links_.empty()) {
    const Link& before = links_.back();
    if (keyframe.id <= before.keyframe.id)
      throw std::invalid_argument("keyframe " + std::to_string(keyframe.id) + " comes after keyframe " +
                                  std::to_string(before.keyframe.id) + ": ids must grow");
    link.way_m = before.way_m;
    link.run = before.run + (keyframe.follows ? 0 : 1);
    if (keyframe.follows) {
      link.T_start_keyframe = before.T_start_keyframe * keyframe.T_previous_keyframe;
      link.covariance_at_start =
          before.covariance_at_start + carried(link.T_start_keyframe, keyframe.covariance);
      link.way_m += keyframe.T_previous_keyframe.translation().norm();
    }
  }
  for (const vision::KeyframeCorner& corner : keyframe.corners) {
    if (corner.landmark_id != 0) link.landmark_ids.push_back(corner.landmark_id);
  }
  std::sort(link.landmark_ids.begin(), link.landmark_ids.end());
  link.keyframe = std::move(keyframe);
  links_.push_back(std::move(link));
}

std::optional<RelativePose> KeyframeChain::relative(std::size_t from, std::size_t to) const {
  if (from > to) {
    const auto reverse = relative(to, from);
    return reverse ? std::optional<RelativePose>(inverse(*reverse)) : std::nullopt;
  }
  const Link &first = links_[from], &second = links_[to];
  if (first.run != second.run) return std::nullopt;
  RelativePose pose;
  pose.T = first.T_start_keyframe.inverse() * second.T_start_keyframe;
  pose.covariance =
      carried(second.T_start_keyframe.inverse(), second.covariance_at_start - first.covariance_at_start);
  const double way = way_m(from, to);
  pose.covariance.topLeftCorner<3, 3>().diagonal().array() += std::pow(params_.share * way, 2);
  pose.covariance.bottomRightCorner<3, 3>().diagonal().array() += std::pow(params_.turn_rad_per_m * way, 2);
  return pose;
}

double KeyframeChain::way_m(std::size_t from, std::size_t to) const {
  return std::abs(links_[to].way_m - links_[from].way_m);
}

std::size_t KeyframeChain::sharedLandmarks(std::size_t a, std::size_t b) const {
  std::vector<std::uint64_t> shared;
  std::set_intersection(links_[a].landmark_ids.begin(), links_[a].landmark_ids.end(),
                        links_[b].landmark_ids.begin(), links_[b].landmark_ids.end(),
                        std::back_inserter(shared));
  return shared.size();
}

}  // namespace stereo_nav::mapping
