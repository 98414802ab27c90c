#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "sim/camera.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::sim {

/// By how much cameras differ from what their calibration says: standard deviations of what a careful
/// calibration with a board leaves over, of which each seed draws one set.
struct CalibrationErrorParams {
  double scale = 0.0;             ///< of all that follow; 0: cameras are exactly as calibrated
  double baseline_share = 0.001;  ///< of the distance between the cameras
  double column_offset_px = 0.1;  ///< of the right camera's principal point
  double focal_share = 0.001;     ///< of the focal length, both cameras alike
  double distortion_px = 0.2;     ///< RMS over the image, each camera for itself
  double mounting_rad = 0.003;    ///< of the left camera's axes in base_link, about each

  void describe(ParameterVisitor& visitor);
};

/// The cameras as they truly are.
struct TrueCameras {
  StereoCalibrationPair calibration;
  /// Takes coordinates of the rectified left optical frame to that which the mounting names: a rotation.
  Eigen::Isometry3d T_nominal_true = Eigen::Isometry3d::Identity();
};

/// Draws the true cameras about the nominal ones; deterministic in `seed`. Pixels are those of `nominal`.
TrueCameras trueCameras(const CalibrationErrorParams& params, const StereoCalibrationPair& nominal,
                        std::uint64_t seed);

}  // namespace stereo_nav::sim
