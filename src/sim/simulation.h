#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/scenario.h"
#include "sim/stereo_cameras.h"

namespace stereo_nav::sim {

/// A scenario brought to life with a seed: what the sensors deliver and the truth, all as functions of time.
/// Const methods may be called from several threads; results depend on the seed alone.
class Simulation {
 public:
  /// `calibration` is for rig.image_scale 1.
  Simulation(const Scenario& scenario, const StereoCalibrationPair& calibration, std::uint64_t seed);

  double duration_s() const { return trajectory_.duration_s(); }
  const Scenario& scenario() const { return scenario_; }
  /// What the calibration says of a camera, which differs from the true one by scenario().calibration_error.
  const CameraCalibration& calibration(Side side) const { return cameras_.calibration(side); }
  const Trajectory& trajectory() const { return trajectory_; }
  const std::vector<PairInstants>& pairs() const { return pairs_; }
  const std::vector<ImuSample>& imu() const { return imu_; }
  /// The wheels as they truly are; none where the scenario has no drive.
  const kinematics::DriveParams& trueWheels() const { return true_drive_; }
  const std::vector<SimulatedTicks>& wheels() const { return wheels_; }
  /// Exposure time of an image, middle of its middle row.
  double imageTime(Side side, std::size_t pair) const;

  /// With what an image is taken.
  const ExposureSetting& exposure(Side side, std::size_t pair) const {
    return (side == Side::kLeft ? left_exposures_ : right_exposures_)[pair];
  }

  /// The raw, distorted image of a pair, CV_8UC1.
  cv::Mat image(Side side, std::size_t pair) const;

  /// True pose of the raw optical frame of a camera.
  Eigen::Isometry3d cameraPose(Side side, double time_s) const;

 private:
  std::vector<ExposureSetting> planned(Side side) const;
  BasePath path() const {
    return [this](double time_s) { return trajectory_.pose(time_s); };
  }

  Scenario scenario_;
  Scene scene_;
  Trajectory trajectory_;
  std::vector<PairInstants> pairs_;
  std::vector<ImuSample> imu_;
  kinematics::DriveParams true_drive_;
  std::vector<SimulatedTicks> wheels_;
  StereoCameras cameras_;
  std::vector<ExposureSetting> left_exposures_, right_exposures_;
};

}  // namespace stereo_nav::sim
