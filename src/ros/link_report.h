#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/console.h>
#include <ros/time.h>

#include <string>

#include "sensors/serial/link_monitor.h"

namespace stereo_nav::ros_io {

/// Says in the log how a device on a link is doing: changes at once, a problem again every ten seconds.
class LinkReport {
 public:
  /// `name`: of the device, as the messages begin.
  void log(const std::string& name, serial::LinkState state, const std::string& message) {
    if (state == serial::LinkState::kWaiting) return;
    const bool good = state == serial::LinkState::kStreaming;
    const ros::WallTime now = ros::WallTime::now();
    const bool changed = state != reported_;
    if (!changed && (good || (now - reported_at_).toSec() < kRepeat_s)) return;
    reported_ = state;
    reported_at_ = now;
    if (good) {
      ROS_INFO_STREAM(name << ": " << message);
    } else {
      ROS_ERROR_STREAM(name << ": " << message);
    }
  }

 private:
  static constexpr double kRepeat_s = 10.0;

  serial::LinkState reported_ = serial::LinkState::kWaiting;
  ros::WallTime reported_at_;
};

/// The summary of a device in /diagnostics. `warning`: what is wrong while it streams; may be empty.
inline void summarise(serial::LinkState state, const std::string& message, const std::string& warning,
                      diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  if (state == serial::LinkState::kWaiting) {
    status.summary(Level::WARN, message);
  } else if (state != serial::LinkState::kStreaming) {
    status.summary(Level::ERROR, message);
  } else if (!warning.empty()) {
    status.summary(Level::WARN, warning);
  } else {
    status.summary(Level::OK, message);
  }
}

}  // namespace stereo_nav::ros_io
