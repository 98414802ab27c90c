#pragma once

#include <optional>

#include "odometry/stereo/imu_rotation.h"
#include "odometry/stereo/motion_prior.h"
#include "odometry/stereo/stereo_images.h"
#include "odometry/stereo/window_optimizer.h"

namespace stereo_nav::odometry {

struct MotionModelParams {
  double acceleration_density = 1.0;
  double angular_acceleration_density = 4.0;

  void describe(ParameterVisitor& visitor);
};

/// How the rig moves: white noise on acceleration drives its twist, and the IMU, where there is one, measures
/// its rotation. Predicts each frame from the previous one and says which motions are impossible. The
/// previous frame is the last one that had a pose.
class MotionModel {
 public:
  MotionModel(const MotionModelParams& params, const ImuRotationParams& imu_params,
              const Eigen::Matrix3d& R_camera_imu)
      : params_(params), imu_(imu_params, R_camera_imu) {}

  void addImu(const ImuSample& sample) { imu_.add(sample); }

  /// The first frame of a map, at a given pose. The velocity is unknown; IMU samples and bias are kept.
  WindowFrame start(const FrameTimes& times, const Eigen::Isometry3d& T_camera_world);
  /// Forgets the velocity, which a sudden stop or a gap in the images has made useless. Returns whether one
  /// was known.
  bool forgetVelocity();

  MotionPrior prior(const FrameTimes& times) const;
  /// The pose at which a new map begins after frames were lost: the previous position, rotated by what the
  /// IMU measured since.
  Eigen::Isometry3d turnedSincePrevious(const FrameTimes& times) const;
  /// Whether the motion changes the velocity since the previous two frames by more than five sigma of the
  /// acceleration: no robot moves in this way, so that the features lie on something that moves on its own.
  bool exceedsAcceleration(const Eigen::Isometry3d& T_current_previous, double interval_s) const;

  /// A frame for the window, with what `prior` expects of the motion between its two stamps.
  static WindowFrame windowFrame(const vision::StereoView& view, const MotionPrior& prior);
  /// Once the current frame has a pose, the motion between the stamps of the previous one is interpolated
  /// instead of extrapolated. `previous` is the previous frame in the window.
  void smoothTimeOffset(const FrameTimes& times, const vision::StereoView& current,
                        WindowFrame& previous) const;

  /// Makes the current frame the previous one: its refined view gives the velocity, and the bias of the IMU
  /// where `prior` had a rotation from it. `rotation_sigma_rad` is that of vision, per axis.
  void update(const FrameTimes& times, const MotionPrior& prior, const vision::StereoView& view,
              double rotation_sigma_rad);

  const FrameTimes& previousTimes() const { return previous_times_; }
  const vision::StereoView& previousView() const { return previous_view_; }

 private:
  MotionModelParams params_;
  ImuRotation imu_;

  FrameTimes previous_times_;
  vision::StereoView previous_view_;
  double previous_interval_s_ = 0.0;  ///< from the frame before the previous one; 0 if there was none
  Eigen::Isometry3d T_previous_before_ = Eigen::Isometry3d::Identity();  ///< motion over that interval
  std::optional<Vector6d> twist_;  ///< of the world in the camera frame at the previous left stamp
};

}  // namespace stereo_nav::odometry
