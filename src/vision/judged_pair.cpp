#include "vision/judged_pair.h"

#include <cmath>
#include <sstream>

#include "stereo_nav/core/input_error.h"
#include "vision/judged_camera.h"

namespace stereo_nav::vision {
namespace {

constexpr double kShortestBaseline_m = 0.02, kLongestBaseline_m = 2.0;

bool isLikelyBaseline(double baseline_m) {
  return baseline_m >= kShortestBaseline_m && baseline_m <= kLongestBaseline_m;
}

/// "it is likely in mm (0.1226 m)", or nothing.
std::string likelyUnit(double baseline_m, double P3) {
  struct Unit {
    const char* name;
    double metres;
  };
  std::ostringstream text;
  for (const Unit& unit : {Unit{"mm", 1e-3}, Unit{"cm", 1e-2}, Unit{"inches", 0.0254}}) {
    if (!isLikelyBaseline(baseline_m * unit.metres)) continue;
    text << "it is likely in " << unit.name << " (" << baseline_m * unit.metres << " m): ";
    return text.str();
  }
  if (isLikelyBaseline(-P3)) text << "P[3] is likely the baseline itself (" << -P3 << " m): ";
  return text.str();
}

void checkBaseline(const StereoCalibration& calibration, double P3) {
  if (isLikelyBaseline(calibration.baseline_m)) return;
  std::ostringstream text;
  text << "the baseline is " << calibration.baseline_m << " m (P[3] of the right camera_info, " << P3
       << ", is -fx * baseline), expected are 0.02 to 2 m; " << likelyUnit(calibration.baseline_m, P3)
       << "was the size of the board's squares given in metres? Calibrate the pair again, or correct P[3]";
  throw InputError(text.str());
}

void checkOrder(double left_P3, double right_P3) {
  if (left_P3 == 0.0 && right_P3 == 0.0) {
    throw InputError(
        "camera_info without baseline: P[3] of the right camera is 0. The cameras were calibrated one by "
        "one; run a stereo calibration");
  }
  if (left_P3 == 0.0 && right_P3 < 0.0) return;
  std::ostringstream text;
  text << "P[3] is " << left_P3 << " in the left camera_info and " << right_P3
       << " in the right one; it must be 0 and -fx * baseline. Are left and right swapped?";
  throw InputError(text.str());
}

bool nearlyEqual(double a, double b) {
  constexpr double kRelative = 1e-6, kSmallest_px = 1e-6;
  return std::abs(a - b) <= kRelative * std::abs(a) + kSmallest_px;
}

/// The geometry that both P share. image_geometry asserts that fx, fy and cy are equal to the last bit.
StereoCalibration sharedGeometry(CameraFields& left, const CameraFields& right) {
  if (left.size != right.size) {
    throw InputError("left camera_info is for " + sizeText(left.size) + ", right for " +
                     sizeText(right.size) + "; both cameras must deliver and be calibrated at one size");
  }
  checkOrder(left.P(0, 3), right.P(0, 3));
  if (!nearlyEqual(left.P(0, 0), right.P(0, 0)) || !nearlyEqual(left.P(1, 1), right.P(1, 1)) ||
      !nearlyEqual(left.P(1, 2), right.P(1, 2))) {
    throw InputError(
        "the projection matrices P of the two camera_infos differ in fx, fy or cy; they are not from one "
        "stereo calibration");
  }
  left.P(0, 0) = right.P(0, 0);
  left.P(1, 1) = right.P(1, 1);
  left.P(1, 2) = right.P(1, 2);
  StereoCalibration calibration;
  calibration.fx = right.P(0, 0);
  calibration.fy = right.P(1, 1);
  calibration.cx = left.P(0, 2);
  calibration.cy = right.P(1, 2);
  calibration.right_cx = right.P(0, 2);
  calibration.baseline_m = -right.P(0, 3) / right.P(0, 0);
  calibration.width = left.size.width;
  calibration.height = left.size.height;
  return calibration;
}

/// Images that were scaled after the calibration have their principal point far from the middle along both
/// axes alike; those that were cropped seldom have.
void noteScaledImages(const std::string& name, const CameraFields& camera, std::vector<std::string>& notes) {
  constexpr double kFar = 0.2;  // of the image's size
  const double x = camera.K(0, 2) / camera.size.width - 0.5;
  const double y = camera.K(1, 2) / camera.size.height - 0.5;
  if (std::abs(x) < kFar || std::abs(y) < kFar || x * y < 0.0) return;
  notes.push_back(name + ": the principal point of K lies far from the middle of " + sizeText(camera.size) +
                  " along both axes; is the calibration of another image size?");
}

}  // namespace

JudgedPair judgePair(const CameraFields& left, const CameraFields& right) {
  const std::string left_name = "the left camera_info", right_name = "the right camera_info";
  JudgedPair pair;
  pair.left = judgeCamera(left_name, left, pair.notes);
  pair.right = judgeCamera(right_name, right, pair.notes);
  pair.calibration = sharedGeometry(pair.left, pair.right);
  checkBaseline(pair.calibration, pair.right.P(0, 3));
  noteScaledImages(left_name, pair.left, pair.notes);
  noteScaledImages(right_name, pair.right, pair.notes);
  keepFromBeingCopied(left_name, pair.left, pair.notes);
  keepFromBeingCopied(right_name, pair.right, pair.notes);
  pair.calibration.validate();
  return pair;
}

}  // namespace stereo_nav::vision
