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
/// for many calibrations that are wrong, and misreads others. They also need a camera_info for each image: a
/// camera that sends fewer gets its latest one with the header of each image. Knows no topics; not
/// thread-safe.
class InfoGate {
 public:
  enum Side { kLeft = 0, kRight = 1 };

  struct Passed {
    Side side;
    sensor_msgs::CameraInfoPtr info;  ///< with the header of the one that came, or of an image
  };

  /// Adds a message. Returns what may be passed on now, in order: messages wait until the pair is judged, at
  /// most kWaiting of each camera.
  std::vector<Passed> addInfo(Side side, const sensor_msgs::CameraInfoConstPtr& info);
  /// Adds header and size of a raw image that came at `now_s` of any running clock.
  std::vector<Passed> addImage(Side side, const std_msgs::Header& header, const cv::Size& size, double now_s);
  /// Hands the latest info to the images whose own one has not come for a tenth of a second, as long as
  /// images are wanted.
  std::vector<Passed> passOnOverdue(double now_s);
  /// Whether images of this camera are wanted: after each change of a calibration, at the start, and always
  /// from a camera that sends fewer camera_infos than images.
  bool needsImages(Side side) const;

  /// Why nothing is passed on; empty where the pair is good, or nothing is known against it yet.
  const std::string& problem() const { return problem_; }
  /// What was assumed or changed, one line each.
  std::vector<std::string> notes() const;

 private:
  static constexpr std::size_t kWaiting = 20;   ///< as many as image_proc's queues hold (image_proc.launch)
  static constexpr std::size_t kCompared = 10;  ///< images that tell how many of them have a camera_info

  struct Image {
    std_msgs::Header header;
    double arrival_s;
    bool has_info;  ///< its own, or has been given the latest one
  };

  struct Camera {
    sensor_msgs::CameraInfoConstPtr info;  ///< the latest
    bool fresh = false;                    ///< it is no older than the last change of the other one
    std::optional<cv::Size> image_size;
    std::deque<std_msgs::Header> waiting;
    std::deque<ros::Time> info_stamps;  ///< of the latest kWaiting
    std::vector<Image> images;          ///< the first kCompared after an info
    std::size_t without_info = 0;       ///< of these
    bool seldom = false;                ///< fewer infos than images
  };

  void judge();
  static void giveOverdue(Camera& camera, double now_s);
  static void keepWaiting(Camera& camera, const std_msgs::Header& header);
  static void checkSize(const char* name, Camera& camera, const sensor_msgs::CameraInfo& judged);
  std::vector<Passed> passOn();

  std::array<Camera, 2> cameras_;
  std::optional<JudgedInfos> judged_;
  std::string problem_;
  std::vector<std::string> notes_;
};

}  // namespace stereo_nav::ros_io
