#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <filesystem>
#include <string>
#include <vector>

#include "nodes/recorder/disk_watch.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::nodes {

/// Parameters of the recorder.
struct RecorderParams {
  std::string folder;
  std::string prefix = "stereo_nav";
  std::string more_topics;
  int split_mb = 2048;
  int buffer_mb = 512;
  double reserve_gb = 1.0;
  double warn_before_min = 10.0;

  void describe(ParameterVisitor& visitor);
};

/// Records the sensors' topics into bags of limited size, with rosbag's own recorder in this process, and
/// reports in log and diagnostics how fast the disk fills.
class RecorderNode {
 public:
  /// Creates the folder. Throws ParameterError if that fails or the disk is already full.
  RecorderNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  /// Records until ROS shuts down, then closes the bags. Returns rosbag's status.
  int run();

 private:
  void watch(const ros::WallTimerEvent& event);
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);
  std::uint64_t recordedBytes() const;

  ros::NodeHandle handle_;
  RecorderParams params_;
  std::vector<std::string> topics_;
  std::filesystem::path folder_;
  std::string unreadable_;      ///< why the folder cannot be read; empty while it can
  std::uint64_t bytes_before_;  ///< size of earlier recordings in the same folder
  DiskWatch disk_;
  DiskWatch::State said_ = DiskWatch::State::kStarting;
  ros::WallTime said_at_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace stereo_nav::nodes
