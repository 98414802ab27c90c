#include "tools/check_calibration/rig_calibration.h"

#include <sensor_msgs/distortion_models.h>

#include <algorithm>
#include <filesystem>

#include "ros/calibration_file.h"
#include "ros/judged_infos.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::tools {
namespace {

sensor_msgs::CameraInfo readCameraInfo(const std::string& path) {
  if (!std::filesystem::exists(path)) {
    throw InputError(path + ": does not exist; --calibration names the folder with left.yaml and right.yaml");
  }
  return ros_io::readCalibrationFile(path);
}

calibration::CameraModel toModel(const sensor_msgs::CameraInfo& info) {
  calibration::CameraModel model;
  model.size = cv::Size(static_cast<int>(info.width), static_cast<int>(info.height));
  std::copy(info.K.begin(), info.K.end(), model.K.val);
  std::copy(info.R.begin(), info.R.end(), model.R.val);
  std::copy(info.P.begin(), info.P.end(), model.P.val);
  model.equidistant = info.distortion_model == sensor_msgs::distortion_models::EQUIDISTANT;
  const int coefficients = static_cast<int>(info.D.size());
  model.D = cv::Mat::zeros(1, model.equidistant ? coefficients : std::max(5, coefficients), CV_64FC1);
  std::copy(info.D.begin(), info.D.end(), model.D.begin<double>());
  return model;
}

}  // namespace

CameraInfos readCalibrationFolder(const std::string& folder) {
  return {readCameraInfo(folder + "/left.yaml"), readCameraInfo(folder + "/right.yaml")};
}

calibration::StereoRig toStereoRig(const CameraInfos& infos) {
  const ros_io::JudgedInfos judged = ros_io::judgeInfos(infos.left, infos.right);
  return {toModel(judged.left), toModel(judged.right), judged.calibration};
}

}  // namespace stereo_nav::tools
