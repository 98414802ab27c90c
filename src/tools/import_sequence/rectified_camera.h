#pragma once

#include <sensor_msgs/CameraInfo.h>

namespace stereo_nav::tools {

/// Pinhole of a rectified camera; px and metres.
struct RectifiedCamera {
  int width;
  int height;
  double fx;
  double fy;
  double cx;
  double cy;
  double baseline_m;  ///< 0 for the left camera
};

/// The camera_info of images that need no undistortion or rectification: D zero, R identity, P = [K | -fx *
/// baseline].
sensor_msgs::CameraInfo toCameraInfo(const RectifiedCamera& camera);

}  // namespace stereo_nav::tools
