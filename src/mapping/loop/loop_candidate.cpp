#include "mapping/loop/loop_candidate.h"

#include <fmt/format.h>

namespace stereo_nav::mapping {

const char* nameOf(LoopStage stage) {
  switch (stage) {
    case LoopStage::kMatches:
      return "matches";
    case LoopStage::kPose:
      return "pose";
    case LoopStage::kInliers:
      return "inliers";
    case LoopStage::kUncertainty:
      return "uncertainty";
    case LoopStage::kConsistency:
      return "consistency";
    case LoopStage::kDrift:
      return "drift";
    case LoopStage::kAccepted:
      break;
  }
  return "accepted";
}

std::string LoopCandidate::reason() const {
  switch (stage) {
    case LoopStage::kMatches:
      return fmt::format("{} of {} mutual matches needed: another place, or seen from too far away", figure,
                         bound);
    case LoopStage::kPose:
      return fmt::format("{} of {} matches needed agree with one pose: another place that looks alike",
                         figure, bound);
    case LoopStage::kInliers:
      return fmt::format(
          "{} of {} landmarks needed found again: another place that looks alike, or too few corners", figure,
          bound);
    case LoopStage::kUncertainty:
      return fmt::format(
          "standard deviation of {:.3f} m above {:.3f}: landmarks too far away, or all in one direction",
          figure, bound);
    case LoopStage::kConsistency:
      return fmt::format("{} of {} loops of the keyframes before needed say the same: a later keyframe may",
                         figure, bound);
    case LoopStage::kDrift:
      return fmt::format(
          "chi-square {:.1f} above {:.1f}: further from where the odometry has it than it drifts; "
          "another place that looks alike, or the drift is more than its covariance says",
          figure, bound);
    case LoopStage::kAccepted:
      break;
  }
  return fmt::format("accepted with {} landmarks", inliers);
}

}  // namespace stereo_nav::mapping
