#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <optional>
#include <string>

#include "core/rotation_history.h"

namespace stereo_nav::odometry {

/// Where the sensors sit: rotations that take coordinates of the left optical frame, and of the IMU, into
/// base_link.
struct SensorAxes {
  Eigen::Matrix3d R_base_camera = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d R_base_imu = Eigen::Matrix3d::Identity();

  Eigen::Matrix3d R_camera_imu() const { return R_base_camera.transpose() * R_base_imu; }
};

/// Holds the turns that the IMU senses against those that the images show, over the last seconds. A
/// contradiction is found once the rig has turned by some 15 degrees, and explained where one of the usual
/// mistakes explains it: rates in deg/s, no turn at all, stamps that are off by a constant time, axes or
/// signs other than those of tf.
class ImuContradiction {
 public:
  explicit ImuContradiction(const SensorAxes& axes) : axes_(axes) {}

  /// `R_current_previous` is the turn of the left camera between two frames as the images show it.
  void add(double previous_s, double current_s, const Eigen::Matrix3d& R_current_previous);
  void clear() { turns_.clear(); }

  /// What is wrong, the likely cause and the remedy; nothing while the two agree, or too little has been
  /// turned. `imu` holds the samples around the frames.
  std::optional<std::string> find(const RotationHistory& imu);
  /// Whether the turns are too different to go on without a closer look.
  bool isSuspected(const RotationHistory& imu);

 private:
  /// Turns of the camera between two frames, as rotation vectors in its axes, rad.
  struct Turn {
    double previous_s, current_s;
    Eigen::Vector3d seen;
    std::optional<Eigen::Vector3d> sensed;  ///< nothing until the IMU's samples cover it
  };
  struct Comparison {
    double seen_rad = 0.0, sensed_rad = 0.0, difference_rad = 0.0;  ///< sums of the lengths
    double unsensed_rad = 0.0;                                      ///< seen while the IMU sensed nothing
    int frames = 0;

    double share() const;  ///< the difference as a share of what was turned
    bool contradicts() const;
  };

  /// Each turn is looked up once: that costs more than the rest of the watch.
  void lookUp(const RotationHistory& imu);
  std::optional<Eigen::Vector3d> sensed(const RotationHistory& imu, const Turn& turn, double delay_s) const;
  /// With the sensed turns multiplied by `factor` and rotated by `R`, taken `delay_s` later, freed from a
  /// constant bias.
  Comparison compare(const RotationHistory& imu, double factor, double delay_s,
                     const Eigen::Matrix3d& R) const;
  std::optional<std::string> explainedByDelay(const RotationHistory& imu) const;
  std::optional<std::string> explainedByAxes(const RotationHistory& imu) const;

  SensorAxes axes_;
  std::deque<Turn> turns_;
};

}  // namespace stereo_nav::odometry
