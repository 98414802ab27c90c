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

calibration::CameraModel toModel(const sensor_msgs::CameraInfo& info, const std::string& side) {
  namespace models = sensor_msgs::distortion_models;
  if (!info.D.empty() && info.distortion_model != models::PLUMB_BOB &&
      info.distortion_model != models::RATIONAL_POLYNOMIAL) {
    throw InputError("the " + side + " camera's lens model is '" + info.distortion_model +
                     "'; plumb_bob and rational_polynomial are known: calibrate as a pinhole camera");
  }
  calibration::CameraModel model;
  model.size = cv::Size(static_cast<int>(info.width), static_cast<int>(info.height));
  std::copy(info.K.begin(), info.K.end(), model.K.val);
  std::copy(info.R.begin(), info.R.end(), model.R.val);
  std::copy(info.P.begin(), info.P.end(), model.P.val);
  model.D = cv::Mat::zeros(1, std::max<int>(5, static_cast<int>(info.D.size())), CV_64FC1);
  std::copy(info.D.begin(), info.D.end(), model.D.begin<double>());
  return model;
}

}  // namespace

CameraInfos readCalibrationFolder(const std::string& folder) {
  return {readCameraInfo(folder + "/left.yaml"), readCameraInfo(folder + "/right.yaml")};
}

calibration::StereoRig toStereoRig(const CameraInfos& infos) {
  const ros_io::JudgedInfos judged = ros_io::judgeInfos(infos.left, infos.right);
  return {toModel(judged.left, "left"), toModel(judged.right, "right"), judged.calibration};
}

}  // namespace stereo_nav::tools
