#include "ros/rectified_view.h"

#include <fmt/format.h>

#include "ros/judged_infos.h"
#include "stereo_nav/core/input_error.h"
#include "vision/judged_camera.h"

namespace stereo_nav::ros_io {

RectifiedView::RectifiedView(const std::string& name, const sensor_msgs::CameraInfo& info) : name_(name) {
  vision::CameraFields fields = vision::judgeCamera(name, toFields(info), notes_);
  vision::keepFromBeingCopied(name, fields, notes_);
  size_ = fields.size;
  model_.fromCameraInfo(toInfo(fields, info.header));
}

cv::Mat RectifiedView::rectify(const cv::Mat& raw) const {
  if (raw.size() != size_)
    throw InputError(fmt::format("the image is {}x{}, {} is for {}x{}; calibrate at the size that is used",
                                 raw.cols, raw.rows, name_, size_.width, size_.height));
  cv::Mat rectified;
  model_.rectifyImage(raw, rectified, cv::INTER_LINEAR);
  return rectified;
}

}  // namespace stereo_nav::ros_io
