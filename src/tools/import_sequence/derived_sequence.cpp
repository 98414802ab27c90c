#include "tools/import_sequence/derived_sequence.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <utility>

namespace stereo_nav::tools {
namespace {

class ReversedFrames : public FrameReader {
 public:
  explicit ReversedFrames(std::unique_ptr<FrameReader> frames) : frames_(std::move(frames)) {}
  std::size_t size() const override { return frames_->size(); }
  cv::Mat read(std::size_t index) override { return frames_->read(size() - 1 - index); }

 private:
  std::unique_ptr<FrameReader> frames_;
};

class MirroredFrames : public FrameReader {
 public:
  explicit MirroredFrames(std::unique_ptr<FrameReader> frames) : frames_(std::move(frames)) {}
  std::size_t size() const override { return frames_->size(); }
  cv::Mat read(std::size_t index) override {
    constexpr int kLeftToRight = 1;
    cv::Mat mirrored;
    cv::flip(frames_->read(index), mirrored, kLeftToRight);
    return mirrored;
  }

 private:
  std::unique_ptr<FrameReader> frames_;
};

/// Turns an instant of a recording from `first` to `last` around.
ros::Time turned(const ros::Time& stamp, const ros::Time& first, const ros::Time& last) {
  return first + (last - stamp);
}

void reverseTrack(CameraTrack& track, const ros::Time& first, const ros::Time& last) {
  std::reverse(track.stamps.begin(), track.stamps.end());
  for (ros::Time& stamp : track.stamps) stamp = turned(stamp, first, last);
  track.frames = std::make_unique<ReversedFrames>(std::move(track.frames));
}

/// Conjugation with the reflection at x = 0: a proper rotation again.
Eigen::Isometry3d reflected(const Eigen::Isometry3d& T) {
  const Eigen::Matrix3d M = Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal();
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = M * T.linear() * M;
  result.translation() = M * T.translation();
  return result;
}

void mirrorInfo(sensor_msgs::CameraInfo& info) {
  const double last_column = static_cast<double>(info.width) - 1.0;
  info.K[2] = last_column - info.K[2];
  info.P[2] = last_column - info.P[2];
  // plumb_bob (k1, k2, p1, p2, k3): p2 belongs to the terms that are odd in x.
  if (info.D.size() >= 4) info.D[3] = -info.D[3];
  for (const std::size_t mixed : {1U, 2U, 3U, 6U}) info.R[mixed] = -info.R[mixed];
}

void mirrorTrack(CameraTrack& track) {
  mirrorInfo(track.info);
  track.frames = std::make_unique<MirroredFrames>(std::move(track.frames));
}

}  // namespace

void reverse(Sequence& sequence) {
  if (sequence.left.stamps.empty()) return;
  const ros::Time first = sequence.left.stamps.front();
  const ros::Time last = sequence.left.stamps.back();
  reverseTrack(sequence.left, first, last);
  reverseTrack(sequence.right, first, last);
  std::reverse(sequence.imu.readings.begin(), sequence.imu.readings.end());
  for (ImuReading& reading : sequence.imu.readings) {
    reading.stamp = turned(reading.stamp, first, last);
    reading.angular_velocity = -reading.angular_velocity;
  }
  std::reverse(sequence.ground_truth.begin(), sequence.ground_truth.end());
  for (CameraPose& pose : sequence.ground_truth) pose.stamp = turned(pose.stamp, first, last);
}

void mirror(Sequence& sequence) {
  sensor_msgs::CameraInfo& right_info = sequence.right.info;
  const Eigen::Translation3d T_left_right(-right_info.P[3] / right_info.P[0], 0.0, 0.0);
  if (sequence.T_body_camera) sequence.T_body_camera = reflected(*sequence.T_body_camera * T_left_right);
  for (CameraPose& pose : sequence.ground_truth) {
    pose.T_world_camera = reflected(pose.T_world_camera * T_left_right);
  }
  for (ImuReading& reading : sequence.imu.readings) {
    reading.linear_acceleration.x() = -reading.linear_acceleration.x();
    // A rate is an axial vector: what lies in the mirror's plane turns the other way.
    reading.angular_velocity.y() = -reading.angular_velocity.y();
    reading.angular_velocity.z() = -reading.angular_velocity.z();
  }
  mirrorTrack(sequence.left);
  mirrorTrack(sequence.right);
  std::swap(sequence.left, sequence.right);
  std::swap(sequence.left.info.P[3], sequence.right.info.P[3]);
}

}  // namespace stereo_nav::tools
