#include "odometry/stereo/frame_prediction.h"

#include <cmath>

namespace stereo_nav::odometry {

Eigen::Vector2d FramePrediction::leftPixel(const Track& track) const {
  const Eigen::Vector2d px = predictedPixel(calibration_, view_, track);
  return shutter_.seenLeft(px, view_.T_camera_world * track.p_world, twist_);
}

Eigen::Matrix2f FramePrediction::patchStep(const Track& track) const {
  const double zoom = (view_.T_camera_world * track.p_world).z() / (T_keyframe_world_ * track.p_world).z();
  if (!(zoom > 0.5 && zoom < 2.0)) return Eigen::Matrix2f::Identity();
  const Eigen::Matrix3d R = (T_keyframe_world_ * view_.T_camera_world.inverse()).linear();
  const double roll = std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1));
  return (zoom * Eigen::Rotation2Dd(roll).toRotationMatrix()).cast<float>();
}

}  // namespace stereo_nav::odometry
