#include "tools/fuse/fusion_input.h"

#include <fmt/format.h>
#include <rosbag/view.h>

#include <algorithm>
#include <optional>

#include "core/planar_motion.h"
#include "odometry/laser/laser_odometry.h"
#include "ros/fusion_messages.h"
#include "ros/laser_feed.h"
#include "ros/laser_recording.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::tools {
namespace {

using estimation::SensorConfig;
using estimation::SensorType;

const char* messageType(SensorType type) {
  switch (type) {
    case SensorType::kOdometry:
      return "nav_msgs/Odometry";
    case SensorType::kPose:
      return "geometry_msgs/PoseWithCovarianceStamped";
    case SensorType::kTwist:
      return "geometry_msgs/TwistWithCovarianceStamped";
    case SensorType::kImu:
      return "sensor_msgs/Imu";
    case SensorType::kFix:
      break;
  }
  return "sensor_msgs/NavSatFix";
}

nav_msgs::Odometry toOdometry(const odometry::LaserOdometryResult& result) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(result.time_s);
  message.child_frame_id = ros_io::frames::kBase;
  const Eigen::Isometry3d T = inSpace(result.T_odom_base);
  const Eigen::Quaterniond q(T.linear());
  message.pose.pose.position.x = T.translation().x();
  message.pose.pose.position.y = T.translation().y();
  message.pose.pose.orientation.w = q.w();
  message.pose.pose.orientation.z = q.z();
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.pose.covariance.data()) =
      spatialCovariance(result.pose_covariance);
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(message.twist.covariance.data()) =
      Matrix6d::Zero();
  return message;
}

/// Reads the sensors one after the other.
class InputReader {
 public:
  InputReader(const FuseOptions& options, const ros_io::RecordedRobot& robot,
              const estimation::FusionConfig& config, const estimation::FusionSetup& setup)
      : options_(options),
        robot_(robot),
        config_(config),
        messages_(config, setup, [&robot](const std::string& frame) { return robot.mounting(frame); }) {}

  FusionInput read() {
    std::size_t with_topic = 0;
    for (std::size_t sensor = 0; sensor < config_.sensors.size(); ++sensor) {
      const SensorConfig& one = config_.sensors[sensor];
      if (const auto topic = topicOf(one.topic)) {
        readTopic(sensor, *topic);
      } else if (one.type == SensorType::kOdometry && withoutRoot(one.topic) == kLaserOdometry &&
                 robot_.find(ros_io::topics::kScan)) {
        computeLaser(sensor);
      } else {
        input_.notes.push_back(
            fmt::format("{}: the bag has no topic {}; it holds {}", one.name, one.topic, robot_.topicList()));
        continue;
      }
      ++with_topic;
    }
    if (with_topic == 0)
      throw InputError(fmt::format("{}: none of the sensors of {} is in the bag, which holds {}",
                                   robot_.path(), options_.config, robot_.topicList()));
    for (const auto& [frame, count] : messages_.unknownFrames())
      input_.notes.push_back(fmt::format(
          "{} messages of '{}' are left out: tf_static has no transform from base_link to it", count, frame));
    std::stable_sort(input_.measurements.begin(), input_.measurements.end(),
                     [](const auto& a, const auto& b) { return a.received_s < b.received_s; });
    return std::move(input_);
  }

 private:
  static constexpr const char* kLaserOdometry = "laser/odom";

  static std::string withoutRoot(const std::string& topic) {
    return topic.substr(std::min(topic.find_first_not_of('/'), topic.size()));
  }

  /// The topic of the bag with this name, whether or not it was recorded with a leading slash.
  std::optional<std::string> topicOf(const std::string& name) const {
    for (const rosbag::ConnectionInfo* connection : rosbag::View(robot_.bag()).getConnections()) {
      if (withoutRoot(connection->topic) == withoutRoot(name)) return connection->topic;
    }
    return std::nullopt;
  }

  void add(double received_s, const std::vector<estimation::Measurement>& measurements) {
    for (const auto& measurement : measurements) input_.measurements.push_back({received_s, measurement});
  }

  template <class Message>
  bool convertAs(std::size_t sensor, const rosbag::MessageInstance& instance, double received_s) {
    const auto message = instance.instantiate<Message>();
    if (message) add(received_s, messages_.convert(sensor, *message));
    return message != nullptr;
  }

  void readTopic(std::size_t sensor, const std::string& topic) {
    const SensorType type = config_.sensors[sensor].type;
    robot_.order().forEach(
        robot_.bag(), {topic}, [&](const rosbag::MessageInstance& message, const ros::Time& received) {
          const double received_s = received.toSec();
          const bool fits =
              (type == SensorType::kOdometry && convertAs<nav_msgs::Odometry>(sensor, message, received_s)) ||
              (type == SensorType::kPose &&
               convertAs<geometry_msgs::PoseWithCovarianceStamped>(sensor, message, received_s)) ||
              (type == SensorType::kTwist &&
               convertAs<geometry_msgs::TwistWithCovarianceStamped>(sensor, message, received_s)) ||
              (type == SensorType::kImu && convertAs<sensor_msgs::Imu>(sensor, message, received_s)) ||
              (type == SensorType::kFix && convertAs<sensor_msgs::NavSatFix>(sensor, message, received_s));
          if (!fits)
            throw InputError(fmt::format("{}: {} is {}, but {} expects {}", robot_.path(), topic,
                                         message.getDataType(), config_.sensors[sensor].name,
                                         messageType(type)));
        });
  }

  void computeLaser(std::size_t sensor) {
    odometry::LaserParams params;
    readParameters(loadYamlFile(options_.laser_config), options_.laser_config, params);
    const ros_io::LaserRecording recording(robot_.path(), {});
    odometry::LaserOdometry odometry(params);
    ros_io::LaserFeed feed(recording, odometry);
    for (const odometry::LaserScan& scan : recording.scans()) {
      feed.upTo(scan.time_s + scan.sweep_s());
      const auto result = odometry.process(scan, recording.T_base_laser());
      // On the robot the pose comes when the scan is complete.
      add(scan.time_s + scan.sweep_s(), messages_.convert(sensor, toOdometry(result)));
    }
    input_.notes.push_back(fmt::format("{}: the bag has no topic {}: it is computed from the {} scans",
                                       config_.sensors[sensor].name, kLaserOdometry,
                                       recording.scans().size()));
  }

  const FuseOptions& options_;
  const ros_io::RecordedRobot& robot_;
  const estimation::FusionConfig& config_;
  ros_io::FusionMessages messages_;
  FusionInput input_;
};

}  // namespace

FusionInput readFusionInput(const FuseOptions& options, const ros_io::RecordedRobot& robot,
                            const estimation::FusionConfig& config, const estimation::FusionSetup& setup) {
  return InputReader(options, robot, config, setup).read();
}

}  // namespace stereo_nav::tools
