#include "tools/common/imu_source.h"

#include <csignal>
#include <iostream>

#include "sensors/serial/link_monitor.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::tools {
namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

void ImuSource::addOptions(boost::program_options::options_description& options) {
  namespace po = boost::program_options;
  options.add_options()                                                                             //
      ("port", po::value(&port), "serial port of the module, or udp:PORT, udp:ADDRESS:PORT")        //
      ("protocol", po::value(&protocol)->default_value(protocol), "angles, raw or phone")           //
      ("baud", po::value(&device.baud_rate)->default_value(device.baud_rate), "speed of the line")  //
      ("angle-order", po::value(&angle_order)->default_value(angle_order),
       "yaw_pitch_roll or roll_pitch_yaw");
}

void ImuSource::finish() {
  YAML::Node node;
  node["protocol"] = protocol;
  node["angle_order"] = angle_order;
  readParameters(node, "options", device);
}

imu::ImuDeviceStatus ImuSource::read(const std::function<bool()>& keep_going,
                                     const imu::ImuDevice::Sink& sink) const {
  std::signal(SIGINT, [](int) { interrupted = 1; });
  imu::ImuDevice reader(device, serial::PortFinder(port));
  serial::LinkState last = serial::LinkState::kWaiting;
  imu::ImuDeviceStatus result;
  while (interrupted == 0 && keep_going()) {
    reader.poll(0.1, sink);
    const imu::ImuDeviceStatus status = reader.status();
    if (status.state == serial::LinkState::kStreaming) result = status;
    const bool bad =
        status.state != serial::LinkState::kStreaming && status.state != serial::LinkState::kWaiting;
    if (bad && status.state != last) std::cerr << port << ": " << status.message << "\n";
    last = status.state;
  }
  return result;
}

}  // namespace stereo_nav::tools
