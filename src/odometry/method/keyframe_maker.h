#pragma once

#include <cstdint>
#include <optional>

#include "stereo_nav/odometry/common/odometry.h"
#include "vision/keyframe.h"

namespace stereo_nav::odometry {

/// Makes keyframes for whoever recognises places, from what an odometry says of its frames: the odometry
/// itself knows nothing of it. Corners are described here, and nowhere else. The thesis' method keeps no map
/// and so gives no keyframes.
class KeyframeMaker {
 public:
  /// To be told of every frame in order, as long as keyframes are wanted. Returns one if the frame became
  /// one.
  std::optional<vision::Keyframe> add(const StereoFrame& frame, const FrameResult& result);

  /// Frames were left out: the next keyframe follows none. Costs nothing.
  void pause() { has_previous_ = false; }

 private:
  vision::Keyframe describe(const StereoFrame& frame, const FrameResult& result);

  bool has_previous_ = false;  ///< and the motion since then is known
  std::uint32_t id_ = 0;       ///< of the last keyframe
  Eigen::Isometry3d T_start_previous_ = Eigen::Isometry3d::Identity();  ///< pose of the last keyframe
  Matrix6d covariance_ = Matrix6d::Zero();                              ///< of the motion since then

  std::uint32_t source_id_ = 0;        ///< the odometry's id of its last keyframe
  std::uint64_t newest_landmark_ = 0;  ///< the largest id handed out
  std::uint64_t landmark_offset_ = 0;  ///< added to the odometry's ids
};

}  // namespace stereo_nav::odometry
