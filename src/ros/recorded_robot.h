#pragma once

#include <rosbag/bag.h>
#include <tf2/buffer_core.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "stereo_nav/core/imu_sample.h"
#include "stereo_nav/core/trajectory.h"
#include "stereo_nav/ros/recorded_clock.h"
#include "stereo_nav/ros/recorded_order.h"

namespace stereo_nav::ros_io {

/// An IMU with its mounting.
struct MountedImu {
  std::vector<ImuSample> samples;  ///< in order of time; empty where there is none, or it is set aside
  Eigen::Matrix3d R_base_imu = Eigen::Matrix3d::Identity();
  std::string set_aside;  ///< why the recorded IMU is not used; empty where it is, or there is none
};

/// Poses of base_link in a recording.
struct BasePoses {
  Trajectory trajectory;
  std::string world_frame;  ///< empty where the messages do not name it
};

/// A bag of one robot whose base moves in the plane: what recordings of wheels and of lasers share. Topics
/// may have a namespace. Throws InputError for an unreadable or damaged file.
class RecordedRobot {
 public:
  explicit RecordedRobot(const std::string& path);

  const std::string& path() const { return path_; }
  const rosbag::Bag& bag() const { return bag_; }
  const RecordedOrder& order() const { return order_; }
  const RecordedClock& clock() const { return clock_; }
  std::vector<std::string>& notes() { return notes_; }
  const std::vector<std::string>& notes() const { return notes_; }

  /// Messages of this topic come at regular intervals: they tell where the recorder's clock was set back.
  void orderBy(const std::string& topic);
  /// Stamps of that topic in the order of recording: they tell where the robot's clock was set back.
  void setClock(const std::vector<ReceivedStamp>& stamps) { clock_ = RecordedClock(stamps); }

  /// The topic with this name in whatever namespace; nothing where there is none. Throws InputError where
  /// there are several.
  std::optional<std::string> find(const std::string& name) const;
  /// The only topic of a type besides `but`; nothing where there is none or are several.
  std::optional<std::string> onlyOfType(const std::string& type, const std::string& but) const;
  std::string topicList() const;

  /// The IMU on `topic`, to be used from `from_s` to `to_s`.
  MountedImu imu(const std::string& topic, double from_s, double to_s) const;
  /// Poses of base_link on `topic`; empty where the bag has no such topic and none was required.
  /// `body_frame`: the frame whose poses it gives, where that is not the one that the topic names.
  BasePoses poses(const std::string& topic, bool required,
                  const std::optional<std::string>& body_frame = std::nullopt) const;
  /// Pose of `frame` in base_link from the recorded static transforms; nothing where these do not hold it.
  std::optional<Eigen::Isometry3d> mounting(const std::string& frame) const;
  /// The same; throws InputError where there is none.
  Eigen::Isometry3d T_base(const std::string& frame) const;

 private:
  std::string path_;
  mutable rosbag::Bag bag_;
  RecordedOrder order_;
  std::vector<std::string> topics_;
  tf2::BufferCore transforms_;
  RecordedClock clock_;
  std::vector<std::string> notes_;
};

}  // namespace stereo_nav::ros_io
