#include "nodes/range_bridge/range_bridge_node.h"

#include <sensor_msgs/Range.h>

#include "core/rig_file.h"
#include "ros/device_messages.h"
#include "ros/parameter_server.h"

namespace stereo_nav::nodes {
namespace {

ros_io::RangeBridgeParams readNodeParams(const ros::NodeHandle& private_handle) {
  ros_io::RangeBridgeParams params;
  ros_io::readParameters({ros_io::fileSource(private_handle, "config"),
                          ros_io::rigSource(private_handle, rig_sections::kRangeFinders),
                          ros_io::serverSource(private_handle, {"diagnostic_period"})},
                         params);
  params.check();
  return params;
}

}  // namespace

RangeBridgeNode::Finder::Finder(const ros_io::RangeFinderParams& finder_params,
                                const std::string& by_id_directory)
    : params(finder_params),
      device(finder_params.device, serial::PortFinder(finder_params.port, by_id_directory)) {}

RangeBridgeNode::RangeBridgeNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : handle_(handle), private_handle_(private_handle), updater_(handle_, private_handle_) {
  const ros_io::RangeBridgeParams params = readNodeParams(private_handle_);
  updater_.setHardwareID("range finders");
  for (const ros_io::RangeFinderParams& finder_params : params.finders) {
    finders_.push_back(std::make_unique<Finder>(finder_params, params.by_id_directory));
    Finder& finder = *finders_.back();
    finder.publisher = handle_.advertise<sensor_msgs::Range>("range/" + finder.params.name, 10);
    updater_.add(
        "range " + finder.params.name,
        [&finder](diagnostic_updater::DiagnosticStatusWrapper& status) { fillStatus(finder, status); });
  }
  for (const auto& finder : finders_) finder->thread = std::thread([this, &finder] { read(*finder); });
  watch_timer_ = handle_.createWallTimer(ros::WallDuration(0.5), &RangeBridgeNode::watch, this);
}

RangeBridgeNode::~RangeBridgeNode() {
  ending_ = true;
  for (const auto& finder : finders_) finder->thread.join();
}

void RangeBridgeNode::read(Finder& finder) {
  constexpr double kPoll_s = 0.1;
  while (!ending_) {
    finder.device.poll(kPoll_s, [&](const range::RangeReading& reading) { publish(finder, reading); });
  }
}

void RangeBridgeNode::publish(Finder& finder, const range::RangeReading& reading) {
  finder.publisher.publish(
      ros_io::toMessage(reading.range_m, finder.params, finder.stamps.at(reading.time_s)));
}

void RangeBridgeNode::watch(const ros::WallTimerEvent& /*event*/) {
  updater_.update();
  for (const auto& finder : finders_) {
    const range::RangeDeviceStatus status = finder->device.status();
    finder->report.log(finder->params.name + ", " + finder->params.port, status.state, status.message);
  }
}

void RangeBridgeNode::fillStatus(Finder& finder, diagnostic_updater::DiagnosticStatusWrapper& status) {
  const range::RangeDeviceStatus device = finder.device.status();
  const auto bad = device.counters.bad_frames - finder.reported_counters.bad_frames;
  const auto good = device.counters.frames - finder.reported_counters.frames;
  finder.reported_counters = device.counters;
  const bool damaged = 10 * bad > good;
  ros_io::summarise(
      device.state, device.message,
      damaged ? "more than a tenth of the frames are damaged: check cable, ground and baud rate" : "",
      status);
  status.add("port", finder.params.port);
  status.add("rate (Hz)", device.rate_hz);
  status.add("range (m)", range::rangeOf(device.last, finder.params.device));
  status.add("strength", device.last.strength);
  status.add("temperature of a Plus or S (C)", device.last.temperature / 8.0 - 256.0);
  status.add("arrival jitter (ms)", 1e3 * device.arrival_jitter_s);
  status.add("frames", device.counters.frames);
  status.add("bad frames", device.counters.bad_frames);
  status.add("lost frames", device.counters.lost);
  status.add("bytes", device.counters.bytes);
  status.add("bytes skipped", device.counters.bytes_skipped);
  status.add("connections", device.connections);
}

}  // namespace stereo_nav::nodes
