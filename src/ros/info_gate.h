#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <array>
#include <deque>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "ros/judged_infos.h"

namespace stereo_nav::ros_io {

/// Passes on the camera_infos of a pair as judgeInfos() leaves them, and none of a pair that it refuses or
/// whose raw images have another size. The image nodelets are behind it: image_geometry ends their process
/// for many calibrations that are wrong, and misreads others. Knows no topics; not thread-safe.
class InfoGate {
 public:
  enum Side { kLeft = 0, kRight = 1 };

  struct Passed {
    Side side;
    sensor_msgs::CameraInfoPtr info;  ///< with the header of the one that came
  };

  /// Adds a message. Returns what may be passed on now, in order: messages wait until the pair is judged, at
  /// most kWaiting of each camera.
  std::vector<Passed> addInfo(Side side, const sensor_msgs::CameraInfoConstPtr& info);
  /// Adds the size of a raw image. It is asked for after each change of a calibration.
  std::vector<Passed> addImageSize(Side side, const cv::Size& size);
  /// Whether the size of this camera's raw images is not known.
  bool needsImageSize(Side side) const { return !cameras_[side].image_size; }

  /// Why nothing is passed on; empty where the pair is good, or nothing is known against it yet.
  const std::string& problem() const { return problem_; }
  /// What was assumed or changed, one line each.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  static constexpr std::size_t kWaiting = 20;  ///< as many as image_proc's queues hold (image_proc.launch)

  struct Camera {
    sensor_msgs::CameraInfoConstPtr info;  ///< the latest
    bool fresh = false;                    ///< it is no older than the last change of the other one
    std::optional<cv::Size> image_size;
    std::deque<sensor_msgs::CameraInfoConstPtr> waiting;
  };

  void judge();
  static void checkSize(const char* name, Camera& camera, const sensor_msgs::CameraInfo& judged);
  std::vector<Passed> passOn();

  std::array<Camera, 2> cameras_;
  std::optional<JudgedInfos> judged_;
  std::string problem_;
  std::vector<std::string> notes_;
};

}  // namespace stereo_nav::ros_io
