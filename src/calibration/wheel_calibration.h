#pragma once

#include <string>
#include <vector>

#include "calibration/wheel_motions.h"
#include "calibration/wheel_windows.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::calibration {

struct WheelCalibrationParams {
  double window_s = 2.0;  ///< over which motions are compared
  // What is known of the nominal geometry; it stays where the runs tell nothing.
  double radius_sigma = 0.05;
  double position_sigma_m = 0.05;
  double direction_sigma_deg = 2.0;
  // The reference.
  double reference_sigma_m = 0.001;
  double reference_sigma_deg = 0.1;
  double reference_walk_m = 0.0;
  double reference_walk_deg = 0.0;
  double reference_scale_sigma = 0.0;
  double time_offset_sigma_s = 0.02;
  double max_share = 0.3;

  void describe(ParameterVisitor& visitor);
};

/// Standard deviations of what was found of a wheel.
struct WheelSigma {
  double radius_m;
  double x_m;
  double y_m;
  double direction_deg;
};

/// Agreement of wheels and reference over all windows.
struct WheelAgreement {
  double translation_rms_m = 0.0;
  double rotation_rms_deg = 0.0;
};

struct WheelCalibration {
  odometry::WheelOdometryParams params;  ///< the drive, slip_sigma_m and scale_sigma are those found
  std::vector<WheelSigma> sigmas;        ///< of each wheel; as large as the assumption where nothing is known
  double track_width_m = 0.0;            ///< widest distance across of parallel wheels; 0 without such wheels
  double track_width_sigma_m = 0.0;
  double reference_scale = 1.0;        ///< by which the reference's lengths are multiplied
  std::vector<double> time_offsets_s;  ///< of each run: the reference's stamps are late by this
  WheelAgreement nominal;
  WheelAgreement found;
  std::size_t windows = 0;
  WheelMotions motions;
  std::string refusal;  ///< empty: usable; else what was seen, the likely cause, the remedy
  bool usable() const { return refusal.empty(); }
};

/// Radius, contact point and direction of every wheel from runs with a reference, by least squares with a
/// Huber loss over the motions in successive windows, e = log(byWheels^-1 byReference), weighted with the
/// covariance of both (Antonelli, Chiaverini and Fusco 2005, "A calibration method for odometry of mobile
/// robots based on the least-squares technique", fit a linear model of differential drives; here all wheels
/// of any drive are free, held by what is assumed of the nominal geometry). Beside them, the scale of the
/// reference's lengths and the constant lateness of each run's stamps are estimated. The slip is chosen so
/// that the windows, and the error of the radii so that the runs as a whole, are as far off as their
/// covariances say. Throws ParameterError for a drive that cannot be used; for poor data `refusal` says what
/// is wrong.
WheelCalibration calibrateWheels(const odometry::WheelOdometryParams& nominal,
                                 const std::vector<WheelRun>& runs,
                                 const WheelCalibrationParams& params = {});

}  // namespace stereo_nav::calibration
