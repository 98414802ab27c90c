#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stereo_nav/core/lie.h"
#include "vision/descriptor.h"

namespace stereo_nav::vision {

/// A corner of a keyframe with its depth.
struct KeyframeCorner {
  std::uint64_t landmark_id = 0;  ///< the same in all keyframes that follow the corner; 0: followed by none
  Eigen::Vector2d px = Eigen::Vector2d::Zero();  ///< left rectified image, as a global shutter would see it
  double disparity_px = 0.0;  ///< as StereoCalibration has it: z = fx * baseline / disparity; <= 0: unknown
  double disparity_sigma_px = 0.0;

  bool hasDepth() const { return disparity_px > 0.0; }
};

/// What an odometry hands to whoever recognises places or makes maps. Poses are of the left optical frame.
struct Keyframe {
  std::uint32_t id = 0;  ///< grows from keyframe to keyframe
  double time_s = 0.0;   ///< stamp of the left image
  /// Whether the motion since the keyframe before is known; it is not after a new start of the odometry.
  bool follows = false;
  Eigen::Isometry3d T_previous_keyframe = Eigen::Isometry3d::Identity();
  /// Of the right perturbation of T_previous_keyframe, axes of this keyframe: m, m, m, rad, rad, rad.
  Matrix6d covariance = Matrix6d::Zero();
  std::vector<KeyframeCorner> corners;
  /// Those of all corners at the first scale, then those at the second one, and so on.
  std::vector<Descriptor> descriptors;

  std::size_t scales() const { return corners.empty() ? 0 : descriptors.size() / corners.size(); }
};

}  // namespace stereo_nav::vision
