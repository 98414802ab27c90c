#include "nodes/laser_bridge/laser_bridge_node.h"

#include <sensor_msgs/LaserScan.h>

#include <cmath>

#include "core/rig_file.h"
#include "ros/parameter_server.h"

namespace stereo_nav::nodes {
namespace {

ros_io::LaserBridgeParams readNodeParams(const ros::NodeHandle& private_handle) {
  ros_io::LaserBridgeParams params;
  ros_io::readParameters(
      {ros_io::fileSource(private_handle, "config"), ros_io::rigSource(private_handle, rig_sections::kLaser),
       ros_io::serverSource(private_handle, {"diagnostic_period"})},
      params);
  return params;
}

}  // namespace

LaserBridgeNode::LaserBridgeNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : handle_(handle),
      private_handle_(private_handle),
      params_(readNodeParams(private_handle_)),
      device_(params_.device, serial::PortFinder(params_.port, params_.by_id_directory)),
      updater_(handle_, private_handle_) {
  scan_ = handle_.advertise<sensor_msgs::LaserScan>("scan", 10);
  updater_.setHardwareID(params_.port);
  updater_.add("laser", this, &LaserBridgeNode::fillStatus);
  watch_timer_ = handle_.createWallTimer(ros::WallDuration(0.5), &LaserBridgeNode::watch, this);
}

void LaserBridgeNode::run() {
  constexpr double kPoll_s = 0.1;
  while (ros::ok()) device_.poll(kPoll_s, [this](const laser::Scan& scan) { publish(scan); });
}

/// The head turns clockwise: beams in the order of their times have falling angles.
void LaserBridgeNode::publish(const laser::Scan& scan) {
  sensor_msgs::LaserScan message;
  message.header.stamp = stamps_.at(scan.time_s);
  message.header.frame_id = params_.frame_id;
  const auto beams = static_cast<double>(scan.ranges_m.size());
  message.angle_min = 0.0F;
  message.angle_increment = static_cast<float>(-2.0 * M_PI / beams);
  message.angle_max = static_cast<float>(-2.0 * M_PI * (beams - 1.0) / beams);
  message.time_increment = static_cast<float>(scan.time_increment_s);
  message.scan_time = static_cast<float>(scan.scan_time_s);
  message.range_min = static_cast<float>(params_.device.scan.range_min_m);
  message.range_max = static_cast<float>(params_.device.scan.range_max_m);
  message.ranges = scan.ranges_m;
  message.intensities = scan.qualities;
  scan_.publish(message);
}

void LaserBridgeNode::watch(const ros::WallTimerEvent& /*event*/) {
  updater_.update();
  const laser::LaserDeviceStatus status = device_.status();
  report_.log(params_.port, status.state, status.message);
}

void LaserBridgeNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const laser::LaserDeviceStatus device = device_.status();
  const auto bad = device.counters.bad_nodes - reported_counters_.bad_nodes;
  const auto good = device.counters.nodes - reported_counters_.nodes;
  reported_counters_ = device.counters;
  std::string warning = device.warning ? device.message : "";
  if (warning.empty() && 100 * bad > good) {
    warning = "more than a hundredth of the samples are damaged: check cable and power supply";
  }
  ros_io::summarise(device.state, device.message, warning, status);
  status.add("port", params_.port);
  status.add("scanner", device.info);
  status.add("scans", device.scans);
  status.add("scan rate (Hz)", device.scan_rate_hz);
  status.add("sample rate (Hz)", device.sample_rate_hz);
  status.add("arrival jitter (ms)", 1e3 * device.arrival_jitter_s);
  status.add("samples", device.counters.nodes);
  status.add("bad samples", device.counters.bad_nodes);
  status.add("dropped samples", device.counters.dropped);
  status.add("bytes", device.counters.bytes);
  status.add("bytes skipped", device.counters.bytes_skipped);
  status.add("connections", device.connections);
}

}  // namespace stereo_nav::nodes
