#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "sim/camera.h"
#include "stereo_nav/calibration/checkerboard.h"
#include "stereo_nav/calibration/stereo_rig.h"

namespace stereo_nav::test {

/// A pair of webcams with plausible numbers: 60 degrees of view, barrel distortion, 0.12 m apart unless
/// given, mounted by hand (the right one turned by up to a degree). `width` is 320 or 640 px.
struct WebcamPair {
  sim::CameraCalibration left, right;
};
WebcamPair webcamPair(int width, double baseline_m = 0.12);

/// The numbers of a calibration as `check_calibration` gets them.
calibration::CameraModel toModel(const sim::CameraCalibration& calibration);
calibration::StereoRig toRig(const sim::CameraCalibration& left, const sim::CameraCalibration& right);

/// Writes a calibration as camera_calibration does.
void writeCalibration(const std::string& path, const std::string& name,
                      const calibration::CameraModel& camera);

/// A calibration by OpenCV from views of the board, as camera_calibration does it (two radial and the
/// tangential coefficients); `rms_px` gets stereoCalibrate's error if given.
calibration::StereoRig calibrateByOpenCv(const std::vector<calibration::BoardCorners>& views,
                                         const calibration::Checkerboard& board, cv::Size size,
                                         double* rms_px = nullptr);

}  // namespace stereo_nav::test
