#pragma once

#include <sensor_msgs/Image.h>
#include <stereo_msgs/DisparityImage.h>

#include <chrono>
#include <cstdint>
#include <optional>

#include "ros/stamp_buffer.h"
#include "stereo_nav/StereoSync.h"
#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::ros_io {

using SteadyTime = std::chrono::steady_clock::time_point;

/// The messages of one stereo frame.
struct FrameMessages {
  sensor_msgs::ImageConstPtr left;
  sensor_msgs::ImageConstPtr right;
  stereo_msgs::DisparityImageConstPtr disparity;  ///< null if the odometry uses none, or before the first one
  ros::Time left_stamp;                           ///< stamp of the left image
  ros::Time right_stamp;                          ///< true exposure time, from camera/sync where there is one
  double rolling_shutter_s = 0.0;                 ///< time from the first row of an image to the last
  SteadyTime arrival;                             ///< when the left image reached the node
  bool after_jump = false;                        ///< first frame after the stamps jumped back
};

struct FrameSynchroniserParams {
  int queue_size = 10;
  double max_time_offset_s = 0.06;
  double rolling_shutter_ms = 0.0;
  odometry::DisparityUse disparity =
      odometry::DisparityUse::kMatched;  ///< not a parameter: follows from the odometry's configuration

  void describe(ParameterVisitor& visitor);
};

/// Assembles stereo frames. Disparity and camera/sync carry the left image's stamp and are matched exactly.
/// The right image is the one that camera/sync names; without camera/sync it is the one with the nearest
/// stamp. It is taken as soon as no later one can be nearer, which is at once if the stamps are equal or
/// differ by less than half the right camera's period. (message_filters' ApproximateTime releases a pair only
/// when the next one arrives, which costs a whole frame of latency.)
///
/// Drop rule: when a frame is complete, older incomplete ones are dropped (topics keep their order, so that
/// these would not be completed any more). When more than `queue_size` left images wait, the oldest is
/// dropped. All drops are counted.
class FrameSynchroniser {
 public:
  explicit FrameSynchroniser(const FrameSynchroniserParams& params);

  void addLeft(const sensor_msgs::ImageConstPtr& image, SteadyTime arrival);
  void addRight(const sensor_msgs::ImageConstPtr& image);
  void addDisparity(const stereo_msgs::DisparityImageConstPtr& disparity);
  void addSync(const StereoSyncConstPtr& sync);

  /// Takes the next complete frame, in order of time. After each message it must be called until it returns
  /// nothing.
  std::optional<FrameMessages> take();

  /// Number of left images that never became part of a frame.
  std::uint64_t dropped() const { return lefts_.dropped() + incomplete_; }

 private:
  struct Left {
    sensor_msgs::ImageConstPtr image;
    SteadyTime arrival;
  };
  enum class Match { kFound, kWaiting, kHopeless };

  Match matchRight(const ros::Time& left_stamp, FrameMessages& frame) const;
  Match matchNearestRight(const ros::Time& left_stamp, FrameMessages& frame) const;
  bool matchDisparity(const ros::Time& left_stamp, FrameMessages& frame) const;
  void forgetUpTo(const FrameMessages& frame);

  FrameSynchroniserParams params_;
  StampBuffer<Left> lefts_;
  StampBuffer<sensor_msgs::ImageConstPtr> rights_;
  StampBuffer<stereo_msgs::DisparityImageConstPtr> disparities_;
  StampBuffer<StereoSyncConstPtr> syncs_;
  double right_period_s_ = 0.0;  ///< shortest recent interval between right images; 0 while unknown
  double rolling_shutter_s_;     ///< last value of camera/sync; before the first one, the parameter
  bool jumped_ = false;
  std::uint64_t incomplete_ = 0;
};

}  // namespace stereo_nav::ros_io
