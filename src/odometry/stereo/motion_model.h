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

/// Where the rig will be if it goes on as it did.
struct Coasted {
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< of the motion since the last pose that is trusted, as below
  bool turn_is_measured = false;           ///< the rotation is the IMU's
  bool velocity_is_known = false;          ///< otherwise the position is held
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
  /// The pose of a frame that has not been measured: it coasts from the last trusted pose on the IMU's
  /// rotation and the last velocity, for at most `coasting_s`. After that the position is held; what remains
  /// unknown is up to the caller. The covariance is that of the left perturbation of T_camera_world: m, rad.
  Coasted coasted(const FrameTimes& times, double coasting_s) const;
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
  /// where `prior` had a rotation from it. `covariance` is that of the pose, by vision.
  void update(const FrameTimes& times, const MotionPrior& prior, const vision::StereoView& view,
              const Matrix6d& covariance);
  /// Whether a pose, with its covariance, lies where coasting leads to while the velocity is known.
  bool expects(const Eigen::Isometry3d& T_camera_world, const Matrix6d& covariance, const FrameTimes& times,
               double coasting_s) const;
  /// The previous frame's pose is what coasted() begins with from here on; before, it was the start of the
  /// map.
  void trustPrevious();

  const FrameTimes& previousTimes() const { return previous_times_; }
  const vision::StereoView& previousView() const { return previous_view_; }

 private:
  MotionModelParams params_;
  ImuRotation imu_;

  FrameTimes previous_times_;
  vision::StereoView previous_view_;
  double previous_interval_s_ = 0.0;  ///< from the frame before the previous one; 0 if there was none
  Eigen::Isometry3d T_previous_before_ = Eigen::Isometry3d::Identity();  ///< motion over that interval
  Vector6d pose_variance_ = Vector6d::Zero();                            ///< of the previous frame, by vision
  std::optional<Vector6d> twist_;  ///< of the world in the camera frame at the previous left stamp

  /// What coasting begins with.
  struct Trusted {
    double time_s = 0.0;
    Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
    std::optional<Vector6d> twist;  ///< mean of the last interval
    Vector6d twist_variance = Vector6d::Zero();
  };
  std::optional<Trusted> trusted_;
};

}  // namespace stereo_nav::odometry
