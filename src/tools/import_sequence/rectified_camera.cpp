#include "tools/import_sequence/rectified_camera.h"

#include <sensor_msgs/distortion_models.h>

namespace stereo_nav::tools {

sensor_msgs::CameraInfo toCameraInfo(const RectifiedCamera& camera) {
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D.assign(5, 0.0);
  info.K = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0};
  // With a zero baseline, -fx * 0 would be minus zero.
  if (camera.baseline_m != 0.0) info.P[3] = -camera.fx * camera.baseline_m;
  return info;
}

}  // namespace stereo_nav::tools
