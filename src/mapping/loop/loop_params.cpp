#include "mapping/loop/loop_params.h"

namespace stereo_nav::mapping {

void VerificationParams::describe(ParameterVisitor& visitor) {
  visitor.integer("max_distance", max_distance, {1, 256}, "",
                  "bits by which the descriptors of mutual matches differ at most");
  visitor.integer("min_matches", min_matches, {4, 10000}, "", "mutual matches of a candidate at least");
  visitor.integer("min_pose_inliers", min_pose_inliers, {4, 10000}, "",
                  "matches that agree with the pose from three of them at least");
  visitor.integer("min_inliers", min_inliers, {6, 10000}, "",
                  "landmarks of place and neighbours that are found again at least");
  visitor.real("max_sigma_m", max_sigma_m, {1e-4, 100.0}, "m",
               "standard deviation of the position that the landmarks leave at most");
  visitSection(visitor, "ransac", ransac);
  visitSection(visitor, "search", search);
}

void AcceptanceParams::describe(ParameterVisitor& visitor) {
  visitor.integer("agreeing", agreeing, {0, 100}, "",
                  "verified loops of keyframes before that have to say the same");
  visitor.integer("within_keyframes", within_keyframes, {1, 1000}, "",
                  "how many keyframes before these may be");
  visitor.real("consistency_share", consistency_share, {0.5, 0.9999999}, "",
               "share of true loops that say the same");
  visitor.real("drift_share", drift_share, {0.5, 0.9999999}, "",
               "share of true loops that lie where the drift of the odometry lets them");
}

void LoopParams::describe(ParameterVisitor& visitor) {
  visitSection(visitor, "retrieval", retrieval);
  visitSection(visitor, "verification", verification);
  visitSection(visitor, "drift", drift);
  visitSection(visitor, "acceptance", acceptance);
}

}  // namespace stereo_nav::mapping
