#include "ros/stereo_processing.h"

#include <opencv2/imgproc.hpp>
#include <sstream>

#include "ros/judged_infos.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::ros_io {

void DisparityParams::describe(ParameterVisitor& visitor) {
  visitor.integer("stereo_algorithm", stereo_algorithm, {0, 1}, "", "0: block matching, 1: semi-global");
  visitor.integer("prefilter_size", prefilter_size, {5, 255}, "px",
                  "normalisation window, odd (block matching)");
  visitor.integer("prefilter_cap", prefilter_cap, {1, 63}, "", "bound on normalised pixels");
  visitor.integer("correlation_window_size", correlation_window_size, {5, 255}, "px", "SAD window, odd");
  visitor.integer("min_disparity", min_disparity, {-2048, 2048}, "px", "smallest disparity searched");
  visitor.integer("disparity_range", disparity_range, {32, 4096}, "px",
                  "disparities searched, a multiple of 16");
  visitor.real("uniqueness_ratio", uniqueness_ratio, {0.0, 100.0}, "%",
               "by how much the best match must beat the second");
  visitor.integer("texture_threshold", texture_threshold, {0, 10000}, "",
                  "windows with less texture have no disparity (block matching)");
  visitor.integer("speckle_size", speckle_size, {0, 1000}, "px",
                  "smaller regions of one disparity are dropped");
  visitor.integer("speckle_range", speckle_range, {0, 31}, "px", "disparity steps that end a region");
  visitor.flag("fullDP", fullDP, "two-pass dynamic programming (semi-global)");
  visitor.real("P1", P1, {0.0, 4000.0}, "", "penalty of a disparity step of 1 (semi-global)");
  visitor.real("P2", P2, {0.0, 4000.0}, "", "penalty of larger disparity steps (semi-global)");
  visitor.integer("disp12MaxDiff", disp12MaxDiff, {0, 128}, "px", "left-right check (semi-global)");
}

StereoProcessing::StereoProcessing(const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right,
                                   const DisparityParams& disparity) {
  const JudgedInfos infos = judgeInfos(left, right);
  notes_ = infos.notes;
  calibration_ = infos.calibration;
  calibration_.left_raw_rows = rawRows(infos.left);
  calibration_.right_raw_rows = rawRows(infos.right);
  model_.fromCameraInfo(infos.left, infos.right);
  // Rounding as in the nodelet's dynamic_reconfigure callback.
  processor_.setStereoType(disparity.stereo_algorithm == 0 ? stereo_image_proc::StereoProcessor::BM
                                                           : stereo_image_proc::StereoProcessor::SGBM);
  processor_.setPreFilterSize(disparity.prefilter_size | 1);
  processor_.setPreFilterCap(disparity.prefilter_cap);
  processor_.setCorrelationWindowSize(disparity.correlation_window_size | 1);
  processor_.setMinDisparity(disparity.min_disparity);
  processor_.setDisparityRange(disparity.disparity_range / 16 * 16);
  processor_.setUniquenessRatio(static_cast<float>(disparity.uniqueness_ratio));
  processor_.setTextureThreshold(disparity.texture_threshold);
  processor_.setSpeckleSize(disparity.speckle_size);
  processor_.setSpeckleRange(disparity.speckle_range);
  processor_.setSgbmMode(disparity.fullDP ? 1 : 0);
  processor_.setP1(static_cast<int>(disparity.P1));
  processor_.setP2(static_cast<int>(disparity.P2));
  processor_.setDisp12MaxDiff(disparity.disp12MaxDiff);
}

cv::Mat StereoProcessing::rectify(const image_geometry::PinholeCameraModel& camera, const cv::Mat& raw,
                                  const char* side) const {
  if (raw.cols != calibration_.width || raw.rows != calibration_.height) {
    std::ostringstream message;
    message << "the " << side << " image is " << raw.cols << "x" << raw.rows << ", its camera_info is for "
            << calibration_.width << "x" << calibration_.height << "; calibrate at the size that is recorded";
    throw InputError(message.str());
  }
  cv::Mat rectified;
  camera.rectifyImage(raw, rectified, cv::INTER_LINEAR);
  return rectified;
}

cv::Mat StereoProcessing::rectifyLeft(const cv::Mat& raw) const {
  return rectify(model_.left(), raw, "left");
}

cv::Mat StereoProcessing::rectifyRight(const cv::Mat& raw) const {
  return rectify(model_.right(), raw, "right");
}

cv::Mat StereoProcessing::disparity(const cv::Mat& left_rect, const cv::Mat& right_rect) const {
  stereo_msgs::DisparityImage message;
  processor_.processDisparity(left_rect, right_rect, model_, message);
  return toDisparityMap(message, calibration_);
}

}  // namespace stereo_nav::ros_io
