#include "tools/import_sequence/sequence_bag.h"

#include <cv_bridge/cv_bridge.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <limits>

#include "core/optical_axes.h"
#include "ros/bag_file.h"
#include "stereo_nav/StereoSync.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"
#include "stereo_nav/ros/pairing.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::tools {
namespace {

namespace topics = ros_io::topics;
namespace frames = ros_io::frames;

/// Frame numbers of a pair.
struct Pair {
  std::size_t left;
  std::size_t right;
};

/// Converts coordinates in optical axes (x right, y down, z forward) into those of a robot (x forward, y
/// left, z up).
Eigen::Isometry3d robotFromOptical() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = opticalToBody();
  return T;
}

/// Chooses the pairs that go into the bag, in order of time.
std::vector<Pair> choosePairs(const Sequence& sequence, const BagOptions& options, BagSummary& summary) {
  const auto synchronous = ros_io::pairStamps(sequence.left.stamps, sequence.right.stamps, {});
  std::vector<Pair> pairs;
  std::size_t due = 0;
  for (const auto& pair : synchronous) {
    if (pair.left % static_cast<std::size_t>(options.every) != 0) continue;
    const std::size_t right = pair.right + static_cast<std::size_t>(options.right_lag_frames);
    if (right < sequence.right.stamps.size()) pairs.push_back({pair.left, right});
  }
  const std::size_t left_count = sequence.left.stamps.size();
  for (std::size_t i = 0; i < left_count; i += static_cast<std::size_t>(options.every)) ++due;
  summary.pairs = pairs.size();
  summary.left_without_partner = due - pairs.size();
  if (!pairs.empty()) return pairs;
  throw InputError(
      "no left image of " + std::to_string(left_count) +
      " has a right one; are the cameras' stamps of one clock, and is --right-lag-frames shorter than the "
      "recording?");
}

std::string encodingOf(const cv::Mat& image) {
  if (image.type() == CV_8UC1) return "mono8";
  return image.type() == CV_16UC1 ? "mono16" : "bgr8";
}

/// Writes messages into the bag; each kind of message has one function.
class BagWriter {
 public:
  BagWriter(Sequence& sequence, const BagOptions& options, std::vector<Pair> pairs, const std::string& path)
      : sequence_(sequence),
        options_(options),
        pairs_(std::move(pairs)),
        right_offset_(options.right_stamp_offset_s),
        bag_(path) {
    const Eigen::Isometry3d T_camera_body =
        sequence.T_body_camera.value_or(Eigen::Isometry3d::Identity()).inverse();
    const bool at_imu = options.base_frame == BaseFrame::kImu;
    T_base_camera_ = at_imu ? T_camera_body.inverse() : robotFromOptical();
    T_base_imu_ = T_base_camera_ * T_camera_body;
    has_imu_ = options.imu && !sequence.imu.readings.empty();
  }

  void write(const std::function<void(std::size_t, std::size_t)>& progress) {
    std::vector<Event> events = collectEvents();
    std::stable_sort(events.begin(), events.end(),
                     [](const Event& a, const Event& b) { return a.time < b.time; });
    writeTransforms(events.front().time);
    std::size_t done = 0;
    for (const Event& event : events) {
      (this->*event.write)(event.index);
      if (event.write == &BagWriter::writeSync) progress(++done, pairs_.size());
    }
    bag_.commit();
  }

 private:
  /// One message, or several with one stamp, that are still to be written.
  struct Event {
    ros::Time time;
    void (BagWriter::*write)(std::size_t index);
    std::size_t index;
  };

  std::vector<Event> collectEvents() const {
    std::vector<Event> events;
    for (std::size_t i = 0; has_imu_ && i < sequence_.imu.readings.size(); ++i) {
      events.push_back({sequence_.imu.readings[i].stamp, &BagWriter::writeImu, i});
    }
    for (std::size_t i = 0; i < sequence_.ground_truth.size(); ++i) {
      events.push_back({sequence_.ground_truth[i].stamp, &BagWriter::writeGroundTruth, i});
    }
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      events.push_back({leftStamp(i), &BagWriter::writeLeft, i});
      events.push_back({rightStamp(i), &BagWriter::writeRight, i});
      events.push_back({leftStamp(i), &BagWriter::writeSync, i});
    }
    return events;
  }

  ros::Time leftStamp(std::size_t i) const { return sequence_.left.stamps[pairs_[i].left]; }
  ros::Time rightStamp(std::size_t i) const {
    return sequence_.right.stamps[pairs_[i].right] + right_offset_;
  }

  static std_msgs::Header header(const ros::Time& stamp, const char* frame_id, std::size_t sequence_number) {
    std_msgs::Header header;
    header.stamp = stamp;
    header.frame_id = frame_id;
    header.seq = static_cast<std::uint32_t>(sequence_number);
    return header;
  }

  void writeLeft(std::size_t i) {
    writeImage(topics::kLeftImage, topics::kLeftInfo, sequence_.left, pairs_[i].left, leftStamp(i));
  }
  void writeRight(std::size_t i) {
    writeImage(topics::kRightImage, topics::kRightInfo, sequence_.right, pairs_[i].right, rightStamp(i));
  }

  void writeImage(const char* image_topic, const char* info_topic, CameraTrack& track, std::size_t index,
                  const ros::Time& stamp) {
    const cv::Mat image = track.frames->read(index);
    sensor_msgs::CameraInfo info = track.info;
    if (image.cols != static_cast<int>(info.width) || image.rows != static_cast<int>(info.height)) {
      throw InputError("frame " + std::to_string(index) + " of " + image_topic + " is " +
                       std::to_string(image.cols) + "x" + std::to_string(image.rows) + ", the calibration " +
                       std::to_string(info.width) + "x" + std::to_string(info.height) +
                       "; all images must have the calibration's size");
    }
    info.header = header(stamp, frames::kLeftOptical, index);
    bag_.write(info_topic, stamp, info);
    bag_.write(image_topic, stamp, *cv_bridge::CvImage(info.header, encodingOf(image), image).toImageMsg());
  }

  void writeSync(std::size_t i) {
    StereoSync sync;
    sync.header = header(leftStamp(i), frames::kLeftOptical, i);
    sync.left_stamp = leftStamp(i);
    sync.right_stamp = rightStamp(i);
    sync.skew_s = (sync.right_stamp - sync.left_stamp).toSec();
    sync.skew_rate = 0.0;  // these layouts' cameras share a clock
    sync.left_sequence = static_cast<std::uint32_t>(pairs_[i].left);
    sync.right_sequence = static_cast<std::uint32_t>(pairs_[i].right);
    sync.left_exposure_s = std::numeric_limits<double>::quiet_NaN();
    sync.right_exposure_s = std::numeric_limits<double>::quiet_NaN();
    bag_.write(topics::kSync, sync.header.stamp, sync);
  }

  void writeImu(std::size_t i) {
    const ImuReading& reading = sequence_.imu.readings[i];
    sensor_msgs::Imu imu;
    imu.header = header(reading.stamp, frames::kImu, i);
    imu.orientation_covariance[0] = -1.0;
    tf2::toMsg(reading.angular_velocity, imu.angular_velocity);
    tf2::toMsg(reading.linear_acceleration, imu.linear_acceleration);
    for (const std::size_t diagonal : {0, 4, 8}) {
      imu.angular_velocity_covariance[diagonal] = sequence_.imu.angular_velocity_variance;
      imu.linear_acceleration_covariance[diagonal] = sequence_.imu.linear_acceleration_variance;
    }
    bag_.write(topics::kImu, reading.stamp, imu);
  }

  void writeGroundTruth(std::size_t i) {
    const CameraPose& truth = sequence_.ground_truth[i];
    // A layout with a body (EuRoC) has a world with z up; without a body, the world has optical axes.
    const Eigen::Isometry3d T_world_layout =
        sequence_.T_body_camera ? Eigen::Isometry3d::Identity() : T_base_camera_;
    nav_msgs::Odometry odometry;
    odometry.header = header(truth.stamp, "world", i);
    odometry.child_frame_id = frames::kBase;
    odometry.pose.pose = tf2::toMsg(T_world_layout * truth.T_world_camera * T_base_camera_.inverse());
    bag_.write(topics::kGroundTruth, truth.stamp, odometry);
  }

  static geometry_msgs::TransformStamped fromBase(const ros::Time& stamp, const char* child,
                                                  const Eigen::Isometry3d& T_base_child) {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T_base_child);
    transform.header = header(stamp, frames::kBase, 0);
    transform.child_frame_id = child;
    return transform;
  }

  void writeTransforms(const ros::Time& stamp) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(fromBase(stamp, frames::kLeftOptical, T_base_camera_));
    if (has_imu_) message.transforms.push_back(fromBase(stamp, frames::kImu, T_base_imu_));
    bag_.writeLatched(topics::kTfStatic, stamp, message);
  }

  Sequence& sequence_;
  BagOptions options_;
  std::vector<Pair> pairs_;
  ros::Duration right_offset_;
  Eigen::Isometry3d T_base_camera_;
  Eigen::Isometry3d T_base_imu_;
  bool has_imu_ = false;
  ros_io::BagFile bag_;
};

}  // namespace

BagSummary writeBag(Sequence& sequence, const BagOptions& options, const std::string& path,
                    const std::function<void(std::size_t, std::size_t)>& progress) {
  BagSummary summary;
  std::vector<Pair> pairs = choosePairs(sequence, options, summary);
  BagWriter(sequence, options, std::move(pairs), path).write(progress);
  return summary;
}

}  // namespace stereo_nav::tools
