#include "eval/alignment.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::eval {
namespace {

Eigen::Isometry3d interpolate(const StampedPose& before, const StampedPose& after, double time_s) {
  const double share = (time_s - before.time_s) / (after.time_s - before.time_s);
  const Eigen::Quaterniond q_before(before.T_world_body.linear());
  const Eigen::Quaterniond q_after(after.T_world_body.linear());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q_before.slerp(share, q_after).toRotationMatrix();
  pose.translation() =
      (1.0 - share) * before.T_world_body.translation() + share * after.T_world_body.translation();
  return pose;
}

}  // namespace

std::optional<Eigen::Isometry3d> poseAt(const Trajectory& trajectory, double time_s,
                                        const AssociationParams& params) {
  const auto after = std::lower_bound(trajectory.begin(), trajectory.end(), time_s,
                                      [](const StampedPose& pose, double t) { return pose.time_s < t; });
  const bool has_after = after != trajectory.end();
  const bool has_before = after != trajectory.begin();
  if (has_after && after->time_s == time_s) return after->T_world_body;
  if (has_before && has_after && after->time_s - std::prev(after)->time_s <= params.max_gap_s) {
    return interpolate(*std::prev(after), *after, time_s);
  }
  const double before_s = has_before ? time_s - std::prev(after)->time_s : INFINITY;
  const double after_s = has_after ? after->time_s - time_s : INFINITY;
  if (std::min(before_s, after_s) > params.max_difference_s) return std::nullopt;
  return before_s <= after_s ? std::prev(after)->T_world_body : after->T_world_body;
}

}  // namespace stereo_nav::eval
