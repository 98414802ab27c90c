#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/calibration_error.h"
#include "sim/exposure_plan.h"
#include "sim/renderer.h"
#include "sim/scenario.h"

namespace stereo_nav::sim {

enum class Side { kLeft, kRight };

/// A scenario brought to life with a seed: what the sensors deliver and the truth, all as functions of time.
/// Const methods may be called from several threads; results depend on the seed alone.
class Simulation {
 public:
  /// `calibration` is for rig.image_scale 1.
  Simulation(const Scenario& scenario, const StereoCalibrationPair& calibration, std::uint64_t seed);

  double duration_s() const { return trajectory_.duration_s(); }
  const Scenario& scenario() const { return scenario_; }
  /// What the calibration says of a camera, which differs from the true one by scenario().calibration_error.
  const CameraCalibration& calibration(Side side) const { return of(nominal_, side); }
  const Trajectory& trajectory() const { return trajectory_; }
  const std::vector<PairInstants>& pairs() const { return pairs_; }
  const std::vector<ImuSample>& imu() const { return imu_; }
  /// The wheels as they truly are; none where the scenario has no drive.
  const kinematics::DriveParams& trueWheels() const { return true_drive_; }
  const std::vector<SimulatedTicks>& wheels() const { return wheels_; }
  /// Exposure time of an image, middle of its middle row.
  double imageTime(Side side, std::size_t pair) const;

  /// With what an image is taken.
  const ExposureSetting& exposure(Side side, std::size_t pair) const { return camera(side).exposures[pair]; }

  /// The raw, distorted image of a pair, CV_8UC1.
  cv::Mat image(Side side, std::size_t pair) const;

  /// True pose of the raw optical frame of a camera.
  Eigen::Isometry3d cameraPose(Side side, double time_s) const;

 private:
  struct Camera {
    CameraCalibration calibration;  ///< the true one
    Eigen::Isometry3d T_base_raw;
    Renderer renderer;
    ImageSensor sensor;
    std::vector<ExposureSetting> exposures;  ///< of each pair's image
  };

  static const CameraCalibration& of(const StereoCalibrationPair& pair, Side side) {
    return side == Side::kLeft ? pair.left : pair.right;
  }
  std::unique_ptr<Camera> makeCamera(Side side, const TrueCameras& cameras) const;
  const Camera& camera(Side side) const { return side == Side::kLeft ? *left_ : *right_; }
  std::vector<ExposureSetting> planned(Side side) const;
  /// What a camera's pixels collect, before the amplifier and without noise: the camera's own, or those of a
  /// `renderer` with fewer.
  cv::Mat signal(Side side, std::size_t pair, const Renderer& renderer, const ExposureSetting& setting) const;
  void flicker(const Shutter& open, cv::Mat& light) const;
  void blur(Side side, const Shutter& open, cv::Mat& light) const;
  Shutter shutter(Side side, std::size_t pair, const ExposureSetting& setting) const;
  double lightLevel(double time_s) const;
  bool blocked(Side side, double time_s) const;

  Scenario scenario_;
  std::uint64_t seed_;
  Scene scene_;
  Trajectory trajectory_;
  std::vector<PairInstants> pairs_;
  std::vector<ImuSample> imu_;
  kinematics::DriveParams true_drive_;
  std::vector<SimulatedTicks> wheels_;
  StereoCalibrationPair nominal_;
  std::unique_ptr<Camera> left_, right_;
};

}  // namespace stereo_nav::sim
