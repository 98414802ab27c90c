#pragma once

#include <string>

#include "calibration/calibration_uncertainty.h"
#include "core/rig_file.h"
#include "stereo_nav/calibration/calibration_check.h"

namespace stereo_nav::tools {

/// The input of a check.
struct CheckedInput {
  std::string input;        ///< file, folder or topics
  std::string calibration;  ///< where it came from
  std::size_t pairs = 0;
  calibration::Checkerboard board;
  calibration::StereoRig rig;
  double largest_time_offset_s = 0.0;  ///< between the images of a pair
};

/// One line about the board in a view: position in m, angles in deg (calibration::BoardAngles), errors in px.
std::string viewLine(const calibration::ViewFigures& view);
/// The heading that belongs to it.
std::string viewHeading();

/// The report for people, and the same for programs (JSON).
std::string reportText(const CheckedInput& input, const calibration::CalibrationCheck& check,
                       const calibration::CalibrationUncertainty& uncertainty);
std::string reportJson(const CheckedInput& input, const calibration::CalibrationCheck& check,
                       const calibration::CalibrationUncertainty& uncertainty);

/// Sets what is known in the section `uncertainty` of a rig file; the rest stays as it is.
void setUncertainty(const calibration::CalibrationUncertainty& uncertainty, RigFile& rig);

}  // namespace stereo_nav::tools
