#include "ros/judged_infos.h"

#include <algorithm>
#include <limits>

#include "stereo_nav/core/input_error.h"
#include "vision/judged_pair.h"

namespace stereo_nav::ros_io {
namespace {

int toInt(std::uint32_t value) {
  return static_cast<int>(std::min<std::uint32_t>(value, std::numeric_limits<int>::max()));
}

}  // namespace

sensor_msgs::CameraInfo toInfo(const vision::CameraFields& fields, const std_msgs::Header& header) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(fields.size.width);
  info.height = static_cast<std::uint32_t>(fields.size.height);
  info.distortion_model = fields.distortion_model;
  info.D = fields.D;
  std::copy(fields.K.val, fields.K.val + 9, info.K.begin());
  std::copy(fields.R.val, fields.R.val + 9, info.R.begin());
  std::copy(fields.P.val, fields.P.val + 12, info.P.begin());
  return info;
}

vision::CameraFields toFields(const sensor_msgs::CameraInfo& info) {
  vision::CameraFields fields;
  fields.size = cv::Size(toInt(info.width), toInt(info.height));
  fields.distortion_model = info.distortion_model;
  fields.D = info.D;
  fields.K = cv::Matx33d(info.K.data());
  fields.R = cv::Matx33d(info.R.data());
  fields.P = cv::Matx34d(info.P.data());
  fields.binning = cv::Size(toInt(info.binning_x), toInt(info.binning_y));
  fields.roi = cv::Rect(toInt(info.roi.x_offset), toInt(info.roi.y_offset), toInt(info.roi.width),
                        toInt(info.roi.height));
  return fields;
}

JudgedInfos judgeInfos(const sensor_msgs::CameraInfo& left, const sensor_msgs::CameraInfo& right) {
  const vision::JudgedPair pair = vision::judgePair(toFields(left), toFields(right));
  if (left.header.frame_id != right.header.frame_id) {
    throw InputError("frame ids differ: left '" + left.header.frame_id + "', right '" +
                     right.header.frame_id +
                     "'; both images and camera_infos must carry the left optical frame");
  }
  return {toInfo(pair.left, left.header), toInfo(pair.right, right.header), pair.calibration, pair.notes};
}

bool isCalibrated(const sensor_msgs::CameraInfo& info) {
  return info.K[0] != 0.0 && info.P[0] != 0.0;
}

}  // namespace stereo_nav::ros_io
