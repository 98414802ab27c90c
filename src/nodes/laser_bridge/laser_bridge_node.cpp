#include "nodes/laser_bridge/laser_bridge_node.h"

#include <sensor_msgs/LaserScan.h>

#include "core/rig_file.h"
#include "ros/device_messages.h"
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

void LaserBridgeNode::publish(const laser::Scan& scan) {
  scan_.publish(ros_io::toMessage(scan, params_, stamps_.at(scan.time_s)));
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
