#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <map>
#include <mutex>
#include <string>

#include "nodes/visual_odometry/odometry_publisher.h"
#include "ros/latency_window.h"
#include "ros/problem_list.h"

namespace stereo_nav::nodes {

/// The health of the node. Logs problems when they begin, while they last and when they end, and reports them
/// with counts and latency on /diagnostics. Thread-safe.
class Health {
 public:
  Health(ros::NodeHandle& handle, ros::NodeHandle& private_handle, const std::string& name);

  void raise(const std::string& key, bool is_error, const std::string& text);
  void clear(const std::string& key);
  /// Raises the problems in `texts` and ends earlier ones of the same `family` that are not among them; an
  /// empty text means that the problem has ended.
  void replace(const std::string& family, bool is_error, const std::map<std::string, std::string>& texts);

  void frameDone(const SessionOutput& output, const FrameCounts& counts, double latency_ms);
  void setCount(const std::string& name, std::uint64_t count);
  void publishDiagnostics() { updater_.force_update(); }

 private:
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::string name_;
  std::mutex mutex_;
  ros_io::ProblemList problems_;
  ros_io::LatencyWindow latency_ms_;
  odometry::FrameResult last_;
  bool processed_ = false;
  FrameCounts counts_;
  std::map<std::string, std::uint64_t> more_counts_;
  diagnostic_updater::Updater updater_;
};

}  // namespace stereo_nav::nodes
