#include "vision/judged_camera.h"

#include "stereo_nav/core/input_error.h"
#include "vision/camera_check.h"
#include "vision/lens_model.h"

namespace stereo_nav::vision {

CameraFields judgeCamera(const std::string& name, CameraFields camera, std::vector<std::string>& notes) {
  checkMatrices(name, camera);
  normaliseLens(name, camera, notes);
  if (cv::norm(camera.R) == 0.0) {
    throw InputError(name + ": R is all zero; calibrate the pair again and take R from the calibration");
  }
  applyWindow(name, camera);
  return camera;
}

void keepFromBeingCopied(const std::string& name, CameraFields& camera, std::vector<std::string>& notes) {
  if (bends(camera) || isRectified(camera)) return;
  constexpr double kNegligible = 1e-9;  // moves no pixel by a thousandth of its width
  camera.D.front() = kNegligible;
  notes.push_back(
      name +
      ": all coefficients of D are 0, with which image_proc would copy the images though R and P move "
      "pixels; the first one is handed on as 1e-9 instead, so that they are rectified");
}

}  // namespace stereo_nav::vision
