#pragma once

#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <tf2/buffer_core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <limits>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "stereo_nav/core/imu_sample.h"
#include "stereo_nav/core/trajectory.h"
#include "stereo_nav/ros/conversions.h"
#include "stereo_nav/ros/pairing.h"
#include "stereo_nav/ros/recorded_clock.h"
#include "stereo_nav/ros/recorded_order.h"

namespace stereo_nav::ros_io {

/// The part of a recording that is read, and how. Times are in seconds.
struct RecordingOptions {
  double start_s = 0.0;                                         ///< after the first left image
  double duration_s = std::numeric_limits<double>::infinity();  ///< counted from start_s
  std::optional<std::string> rig;           ///< namespace of the rig, where the recording holds several
  std::optional<double> rolling_shutter_s;  ///< replaces the value of camera/sync; 0: global shutter
};

/// One recorded pair of raw images, converted to grey, with the true exposure times.
struct RawPair {
  double left_time_s;        ///< when the left image was taken
  double right_time_s;       ///< when the right image was taken
  double rolling_shutter_s;  ///< from the first row to the last
  cv::Mat left;              ///< CV_8UC1
  cv::Mat right;             ///< CV_8UC1
};

/// A bag with the topics of a stereo rig: `camera/{left,right}/{image_raw,camera_info}` (or
/// `image_raw/compressed`, where there is no `image_raw`) and, where recorded,
/// `camera/sync`, `imu/data` or `imu_quat`, `tf_static` and ground truth. It is read without a ROS master.
/// Opening reads everything but the images, which are streamed. A prefix common to all topics (a namespace)
/// is detected. Throws InputError for an unreadable or damaged file, for missing topics (the message lists
/// those that exist) and for NaN in the IMU's messages.
class Recording {
 public:
  /// Opens the bag and reads everything but the images.
  Recording(const std::string& path, const RecordingOptions& options);

  /// The first camera_info of the left camera that is not all zero; drivers publish such ones at their start.
  const sensor_msgs::CameraInfo& leftInfo() const { return left_info_; }
  /// The same of the right camera.
  const sensor_msgs::CameraInfo& rightInfo() const { return right_info_; }
  /// What had to be assumed, or was left out; one line each.
  const std::vector<std::string>& notes() const { return notes_; }
  /// Number of pairs that forEachPair() hands out.
  std::size_t pairs() const { return pairs_.size(); }
  /// Number of images that belong to no pair.
  std::size_t unpairedImages() const { return unpaired_images_; }
  /// All IMU samples in order of time.
  const std::vector<ImuSample>& imu() const { return imu_; }
  /// Frame of the IMU's messages; nothing if there is no IMU, or its messages have no header (the thesis'
  /// imu_quat).
  const std::optional<std::string>& imuFrame() const { return imu_frame_; }
  /// Number of stretches between which the host's clock was set back. All times that are handed out lie on
  /// one line of time: those after a jump are moved to where they would lie without it.
  std::size_t stretches() const { return std::max(clock_.jumps(), order_.setBacks()) + 1; }
  /// What was added to the recorded stamp of an image.
  double clockOffset_s(double time_s) const { return clock_.offset_s(time_s); }
  /// Stamp of the first left image.
  double firstLeft_s() const { return left_stamps_.front().toSec(); }
  /// Stamp of the last left image.
  double lastLeft_s() const { return left_stamps_.back().toSec(); }

  /// Pose of frame `source` in frame `target` from the recorded static transforms; nothing if these do not
  /// connect the two frames.
  std::optional<Eigen::Isometry3d> transform(const std::string& target, const std::string& source) const;

  /// Poses of a topic (nav_msgs/Odometry, geometry_msgs/PoseStamped or TransformStamped) and the frame that
  /// they describe, which is empty when the type does not name it. The trajectory is empty when the bag has
  /// no such topic and none was required.
  struct GroundTruth {
    Trajectory trajectory;   ///< in order of time
    std::string body_frame;  ///< the frame that the poses describe
  };
  /// The ground truth on `topic`; throws InputError where it is `required` and missing.
  GroundTruth groundTruth(const std::string& topic, bool required) const;

  /// Passes every pair once, in order of the left stamps. Throws InputError for an image that cannot be used.
  void forEachPair(const std::function<void(const RawPair&)>& handle) const;

 private:
  struct Topics {
    std::string left, right, left_info, right_info;
    std::optional<std::string> sync, imu, imu_quat;
  };

  void findTopics(const RecordingOptions& options);
  void readMessages();
  void readImu();
  void pairImages(const RecordingOptions& options);
  std::optional<std::string> find(const std::string& relative_name) const;
  std::string require(const std::string& relative_name) const;
  std::string requireImages(const std::string& relative_name) const;
  std::string topicList() const;
  sensor_msgs::CameraInfo firstInfo(const std::string& topic);

  std::string path_;
  mutable rosbag::Bag bag_;
  std::vector<std::string> all_topics_;
  Topics topics_;
  std::string rig_prefix_;  ///< of the rig's topics, without slash at its start
  bool several_rigs_ = false;
  sensor_msgs::CameraInfo left_info_;
  sensor_msgs::CameraInfo right_info_;
  std::vector<ImuSample> imu_;
  std::optional<std::string> imu_frame_;
  tf2::BufferCore transforms_;
  std::vector<ros::Time> left_stamps_;
  std::vector<ros::Time> right_stamps_;
  std::vector<StampPair> pairs_;
  std::size_t unpaired_images_ = 0;
  RecordedOrder order_;
  RecordedClock clock_;
  std::vector<ros::Time> left_in_order_;   ///< stamps of all left images in the order of recording
  std::vector<ros::Time> right_in_order_;  ///< likewise
  std::vector<std::string> notes_;
  int mono16_bits_ = 16;         ///< that mono16 images fill
  bool mono16_swapped_ = false;  ///< whether their bytes are exchanged
};

}  // namespace stereo_nav::ros_io
