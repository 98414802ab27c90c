#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "mapping/loop/landmark_match.h"
#include "vision/keyframe.h"

namespace stereo_nav::mapping {

inline vision::StereoCalibration testCamera() {
  vision::StereoCalibration camera;
  camera.fx = camera.fy = 400.0;
  camera.cx = camera.right_cx = 320.0;
  camera.cy = 240.0;
  camera.baseline_m = 0.12;
  camera.width = 640;
  camera.height = 480;
  return camera;
}

inline vision::Descriptor randomDescriptor(std::mt19937_64& random) {
  return {random(), random(), random(), random()};
}

/// The same descriptor as it is seen again: `bits` of it differ.
inline vision::Descriptor seenAgain(vision::Descriptor descriptor, int bits, std::mt19937_64& random) {
  for (int i = 0; i < bits; ++i) {
    const std::uint64_t bit = random() % vision::kDescriptorBits;
    descriptor[bit / 64] ^= std::uint64_t{1} << (bit % 64);
  }
  return descriptor;
}

/// Landmarks at random places of a room around the origin, with descriptors of their own.
class LandmarkWorld {
 public:
  explicit LandmarkWorld(std::uint64_t seed, int landmarks = 1500) : random_(seed) {
    std::uniform_real_distribution<double> across(-6.0, 6.0), up(-1.5, 1.5);
    for (int i = 0; i < landmarks; ++i) {
      points_.emplace_back(across(random_), up(random_), across(random_));
      descriptors_.push_back(randomDescriptor(random_));
    }
  }

  /// What a camera sees, with noise; `follows` and its motion are left to the caller. At most `most` corners.
  vision::Keyframe seenFrom(const Eigen::Isometry3d& T_world_camera, std::uint32_t id,
                            std::size_t most = 250) {
    const vision::StereoCalibration camera = testCamera();
    std::normal_distribution<double> normal;
    vision::Keyframe keyframe;
    keyframe.id = id;
    keyframe.time_s = 0.1 * id;
    const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
    for (std::size_t i = 0; i < points_.size() && keyframe.corners.size() < most; ++i) {
      const Eigen::Vector3d p_camera = T_camera_world * points_[i];
      if (p_camera.z() < 0.5) continue;
      const Eigen::Vector3d px = measurementOf(camera, p_camera);
      if (px.x() < 0.0 || px.y() < 0.0 || px.x() > camera.width || px.y() > camera.height) continue;
      vision::KeyframeCorner corner;
      corner.landmark_id = (std::uint64_t{id} << 32) + i;  // nobody follows it from keyframe to keyframe
      corner.px =
          px.head<2>() + kCornerSigma_px / std::sqrt(2.0) * Eigen::Vector2d(normal(random_), normal(random_));
      corner.disparity_sigma_px = 0.3;
      corner.disparity_px = std::max(0.1, px.z() + corner.disparity_sigma_px * normal(random_));
      keyframe.corners.push_back(corner);
      keyframe.descriptors.push_back(seenAgain(descriptors_[i], 20, random_));
    }
    return keyframe;
  }

 private:
  std::mt19937_64 random_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<vision::Descriptor> descriptors_;
};

/// Pose after `share` of a circle of 1 m radius, looking along the way.
inline Eigen::Isometry3d onCircle(double share) {
  const double angle = 2.0 * M_PI * share;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = expRotation({0.0, -angle, 0.0});
  T.translation() << std::cos(angle), 0.0, std::sin(angle);
  return T;
}

}  // namespace stereo_nav::mapping
