#pragma once

#include <optional>
#include <vector>

#include "stereo_nav/calibration/calibration_check.h"

namespace stereo_nav::calibration {

/// By how much a calibration may be off: standard deviations, as estimation::UncertaintyParams takes them.
/// Nothing where the views do not tell.
struct CalibrationUncertainty {
  std::optional<double> baseline_share;
  std::optional<double> column_offset_px;
  std::optional<double> focal_share;
  std::optional<double> distortion_px;
};

/// Fits a correction of baseline, right principal point and focal length together with the poses of the board
/// (linear least squares, the poses eliminated by the Schur complement: Triggs et al., "Bundle adjustment - a
/// modern synthesis", section 6.1). A standard deviation is the root of the squares of the correction
/// found, which the calibration in use lacks, and of its own standard deviation. The latter is the
/// jackknife's over the views (Efron and Stein 1981), since errors of neighbouring corners go together; where
/// it is large the views do not tell: they need at least five views, near and far. An error of the board's
/// own size cannot be seen by it. What lens models leave over is the RMS of the mean residuals of parts of
/// the image, less their noise.
CalibrationUncertainty calibrationUncertainty(const StereoRig& rig, const Checkerboard& board,
                                              const std::vector<ViewFigures>& views);

}  // namespace stereo_nav::calibration
