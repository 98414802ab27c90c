#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "ros/link_report.h"
#include "ros/range_bridge_params.h"
#include "ros/steady_stamps.h"
#include "sensors/range/range_device.h"

namespace stereo_nav::nodes {

/// Range finders on topics range/NAME, each read by a thread of its own.
class RangeBridgeNode {
 public:
  /// Throws ParameterError.
  RangeBridgeNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~RangeBridgeNode();
  RangeBridgeNode(const RangeBridgeNode&) = delete;
  RangeBridgeNode& operator=(const RangeBridgeNode&) = delete;

 private:
  struct Finder {
    Finder(const ros_io::RangeFinderParams& finder_params, const std::string& by_id_directory);

    const ros_io::RangeFinderParams params;
    range::RangeDevice device;
    ros::Publisher publisher;
    ros_io::SteadyStamps stamps;
    ros_io::LinkReport report;
    range::TfminiCounters reported_counters;
    std::thread thread;
  };

  void read(Finder& finder);
  static void publish(Finder& finder, const range::RangeReading& reading);
  static void fillStatus(Finder& finder, diagnostic_updater::DiagnosticStatusWrapper& status);
  void watch(const ros::WallTimerEvent& event);

  ros::NodeHandle handle_, private_handle_;
  diagnostic_updater::Updater updater_;
  std::vector<std::unique_ptr<Finder>> finders_;
  std::atomic<bool> ending_{false};
  ros::WallTimer watch_timer_;
};

}  // namespace stereo_nav::nodes
