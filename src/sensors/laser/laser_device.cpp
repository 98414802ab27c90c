#include "sensors/laser/laser_device.h"

#include <algorithm>
#include <array>
#include <string>

#include "sensors/serial/frame_link.h"
#include "sensors/serial/steady_clock.h"

namespace stereo_nav::laser {
namespace {

/// Time over which rates and jitter are measured.
constexpr double kReportPeriod_s = 5.0;
/// A scan that brings no nodes for so long is begun again. The motor needs two seconds to get going.
constexpr double kPatience_s = 5.0;

}  // namespace

void LaserDeviceParams::describe(ParameterVisitor& visitor) {
  visitor.integer("baud_rate", baud_rate, {300, 12000000}, "baud", "speed of the serial line");
  visitor.real("latency_s", latency_s, {-1.0, 1.0}, "s",
               "age of a sample when the scanner begins to send it; subtracted from the stamps");
  scan.describe(visitor);
  link.describe(visitor);
  visitSection(visitor, "stamps", stamps);
}

LaserDevice::LaserDevice(const LaserDeviceParams& params, serial::PortFinder port)
    : params_(params),
      finder_(std::move(port)),
      decoder_(params.scan, params.stamps, params.baud_rate, params.latency_s),
      session_([this](rplidar::Command command) { write(command); }),
      link_(params.link, [this] { return open(); }) {}

LaserDevice::~LaserDevice() {
  const auto port = port_.lock();
  if (!port) return;
  try {
    write(rplidar::Command::kStop);
    port->setDtr(true);
  } catch (const serial::SerialError&) {
    // Unplugged just now: nothing is left to be stopped.
  }
}

/// The adapter of the A1 turns the motor while DTR is off. Opening a port switches DTR on.
std::shared_ptr<serial::ByteSource> LaserDevice::open() {
  auto port = std::make_shared<serial::SerialPort>(finder_.locate(), params_.baud_rate);
  finder_.remember();
  port_ = port;
  port->setDtr(false);
  decoder_.reset();
  session_.begin(serial::steadyNow_s());
  return port;
}

void LaserDevice::write(rplidar::Command command) {
  const auto bytes = rplidar::request(command);
  if (const auto port = port_.lock()) port->write(bytes.data(), bytes.size());
}

void LaserDevice::poll(double timeout_s, const ScanAssembler::Sink& sink) {
  std::array<std::uint8_t, 4096> buffer{};
  const std::size_t size = link_.read(buffer.data(), buffer.size(), timeout_s);
  if (port_.expired()) return;
  try {
    take(buffer.data(), size, sink);
  } catch (const serial::SerialError& error) {
    link_.disconnect(error);
  }
}

void LaserDevice::take(const std::uint8_t* data, std::size_t size, const ScanAssembler::Sink& sink) {
  const double now_s = serial::steadyNow_s();
  const std::uint64_t nodes_before = decoder_.counters().nodes;
  const bool was_scanning = session_.scanning();
  const std::size_t used = session_.update(data, size, now_s);
  if (session_.scanning()) {
    if (!was_scanning) beginScan();
    decoder_.push(data + used, size - used, now_s, [&](const Scan& scan) { deliver(scan, sink); });
  }
  updateStatus(nodes_before, now_s);
  if (session_.scanning() && now_s - std::max(last_node_s_, session_.scanningSince_s()) > kPatience_s) {
    session_.begin(now_s);
  }
}

void LaserDevice::beginScan() {
  decoder_.reset();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (session_.info()) status_.info = session_.info()->text();
}

void LaserDevice::deliver(const Scan& scan, const ScanAssembler::Sink& sink) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++status_.scans;
    status_.scan_rate_hz = 1.0 / scan.scan_time_s;
  }
  sink(scan);
}

void LaserDevice::updateStatus(std::uint64_t nodes_before, double now_s) {
  if (decoder_.counters().nodes > nodes_before) {
    link_.delivered();
    last_node_s_ = now_s;
  }
  serial::JitterMeter& jitter = decoder_.jitter();
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.counters = decoder_.counters();
  problem_ = session_.problem();
  if (jitter.duration_s() < kReportPeriod_s) return;
  status_.sample_rate_hz = jitter.rate_hz();
  status_.arrival_jitter_s = jitter.arrivalJitter_s();
  jitter.restart();
}

LaserDeviceStatus LaserDevice::status() const {
  const serial::LinkStatus link = link_.status();
  const std::lock_guard<std::mutex> lock(mutex_);
  LaserDeviceStatus status = status_;
  status.state = link.state;
  status.connections = link.connections;
  if (status.state != serial::LinkState::kStreaming) {
    status.sample_rate_hz = status.scan_rate_hz = status.arrival_jitter_s = 0.0;
  }
  status.warning = status.state == serial::LinkState::kStreaming && !problem_.empty();
  status.message = explain(link);
  return status;
}

/// The caller holds the mutex.
std::string LaserDevice::explain(const serial::LinkStatus& link) const {
  if (link.state != serial::LinkState::kDisconnected && !problem_.empty()) return problem_;
  serial::LinkWords words;
  words.waiting = "connected, waiting for the first samples";
  words.silent = ": is the scanner powered, and does its motor turn?";
  words.no_frames =
      "bytes arrive but no samples: does the motor turn steadily? Otherwise check the baud rate (" +
      std::to_string(params_.baud_rate) + " here)";
  words.streaming = "scanning";
  return serial::explain(link, words);
}

}  // namespace stereo_nav::laser
