#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>

#include "sim/calibration_error.h"
#include "sim/exposure_plan.h"
#include "sim/renderer.h"
#include "sim/scenario.h"
#include "sim/trajectory.h"

namespace stereo_nav::sim {

enum class Side { kLeft, kRight };

/// The two cameras of a robot, wherever it goes. They ask for its poses in the thread that renders. Const
/// methods may be called from several threads; results depend on the arguments and the seed alone.
class StereoCameras {
 public:
  /// `calibration` is for rig.image_scale 1.
  StereoCameras(const Scenario& scenario, const StereoCalibrationPair& calibration, std::uint64_t seed);

  /// What the calibration says of a camera, which differs from the true one by the calibration error.
  const CameraCalibration& calibration(Side side) const { return of(nominal_, side); }
  /// True pose of the raw optical frame of a camera on the base.
  const Eigen::Isometry3d& T_base_raw(Side side) const { return camera(side).T_base_raw; }

  /// The raw, distorted image whose exposure has its middle at `middle_s`, CV_8UC1. Its noise is that of
  /// image `index`.
  cv::Mat image(Side side, const Scene& scene, const BasePath& base, double middle_s,
                const ExposureSetting& setting, std::size_t index) const;
  /// What the automatic exposure sees of such an image: its mean grey level after the tone curve.
  double metered(Side side, const Scene& scene, const BasePath& base, double middle_s,
                 const ExposureSetting& setting) const;

 private:
  struct Camera {
    CameraCalibration calibration;  ///< the true one
    Eigen::Isometry3d T_base_raw;
    double gain;
    Renderer renderer;
    Renderer meter;  ///< with few pixels
    ImageSensor sensor;
  };

  static const CameraCalibration& of(const StereoCalibrationPair& pair, Side side) {
    return side == Side::kLeft ? pair.left : pair.right;
  }
  std::unique_ptr<Camera> makeCamera(Side side, const TrueCameras& cameras) const;
  const Camera& camera(Side side) const { return side == Side::kLeft ? *left_ : *right_; }
  /// What a camera's pixels collect, before the amplifier and without noise: the camera's own, or those of a
  /// `renderer` with fewer.
  cv::Mat signal(Side side, const Scene& scene, const Renderer& renderer, const BasePath& base,
                 double middle_s, const ExposureSetting& setting) const;
  void flicker(const Shutter& open, cv::Mat& light) const;
  void blur(Side side, const BasePath& base, const Shutter& open, cv::Mat& light) const;
  Shutter shutter(double middle_s, const ExposureSetting& setting) const;
  double lightLevel(double time_s) const;
  bool blocked(Side side, double time_s) const;

  const Scenario scenario_;
  const std::uint64_t seed_;
  StereoCalibrationPair nominal_;
  std::unique_ptr<Camera> left_, right_;
};

}  // namespace stereo_nav::sim
