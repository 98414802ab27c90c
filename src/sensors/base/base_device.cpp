#include "sensors/base/base_device.h"

#include <array>
#include <sstream>

#include "sensors/serial/steady_clock.h"

namespace stereo_nav::base {
namespace {

/// Time over which rate and jitter are measured.
constexpr double kReportPeriod_s = 5.0;
/// A jump of the controller's clock by this much against the arrivals counts as a step.
constexpr double kClockStep_s = 0.04;

}  // namespace

void BaseDeviceParams::describe(ParameterVisitor& visitor) {
  visitor.integer("baud_rate", baud_rate, {300, 12000000}, "baud", "speed of the serial line");
  visitor.real("latency_s", latency_s, {-1.0, 1.0}, "s",
               "age of the counters when the controller begins to send them; subtracted from the stamps");
  link.describe(visitor);
  visitSection(visitor, "stamps", stamps);
}

BaseDevice::BaseDevice(const BaseDeviceParams& params, serial::PortFinder port)
    : params_(params),
      finder_(std::move(port)),
      decoder_(params.baud_rate),
      stamps_(params.stamps),
      link_(params.link, [this] { return open(); }) {}

std::shared_ptr<serial::ByteSource> BaseDevice::open() {
  auto port = std::make_shared<serial::SerialPort>(finder_.locate(), params_.baud_rate);
  finder_.remember();
  decoder_.reset();
  stamps_.reset();
  port_ = port;
  const std::lock_guard<std::mutex> lock(mutex_);
  jitter_.restart();
  return port;
}

void BaseDevice::poll(double timeout_s, const Sink& sink) {
  std::array<std::uint8_t, 4096> buffer{};
  const std::size_t size = link_.read(buffer.data(), buffer.size(), timeout_s);
  decoder_.push(buffer.data(), size, serial::steadyNow_s(),
                [&](const DecodedTelemetry& frame) { deliver(frame, sink); });
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.counters = decoder_.counters();
}

void BaseDevice::deliver(const DecodedTelemetry& frame, const Sink& sink) {
  BaseReading reading;
  const double sent_s = stamps_.stamp(frame.device_clock_s, kClockStep_s, frame.arrival_s);
  reading.time_s = sent_s - frame.wire_s - params_.latency_s;
  reading.arrival_s = frame.arrival_s;
  reading.telemetry = frame.telemetry;
  link_.delivered();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    jitter_.add(frame.arrival_s, sent_s, frame.device_clock_s);
    if (jitter_.duration_s() > kReportPeriod_s) {
      status_.rate_hz = jitter_.rate_hz();
      status_.arrival_jitter_s = jitter_.arrivalJitter_s();
      status_.stamp_jitter_s = jitter_.stampJitter_s();
      jitter_.restart();
    }
  }
  sink(reading);
}

void BaseDevice::send(const Command& command) {
  std::array<std::uint8_t, maxFrameBytes<Command>()> frame{};
  const std::size_t size = encode<Crc32>(command, frame.data());
  bool sent = false;
  if (const auto port = port_.lock()) {
    try {
      port->write(frame.data(), size);
      sent = true;
    } catch (const serial::SerialError& error) {
      link_.disconnect(error);
    }
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  ++(sent ? status_.commands_sent : status_.commands_unsent);
}

BaseDeviceStatus BaseDevice::status() const {
  const serial::LinkStatus link = link_.status();
  const std::lock_guard<std::mutex> lock(mutex_);
  BaseDeviceStatus status = status_;
  status.state = link.state;
  status.connections = link.connections;
  if (status.state != serial::LinkState::kStreaming) {
    status.rate_hz = status.arrival_jitter_s = status.stamp_jitter_s = 0.0;
  }
  status.message = explain(link);
  return status;
}

std::string BaseDevice::explain(const serial::LinkStatus& link) const {
  using serial::LinkState;
  std::ostringstream text;
  text.precision(3);
  switch (link.state) {
    case LinkState::kDisconnected:
      return link.fault;
    case LinkState::kWaiting:
      return "connected, waiting for the first telemetry";
    case LinkState::kSilent:
      text << "no bytes for " << link.silent_s
           << " s: is the controller powered, its program running, and its TX wired to the adapter's RX?";
      break;
    case LinkState::kNoFrames:
      text << "bytes arrive but no telemetry: check the baud rate (" << params_.baud_rate
           << " here) and that the controller's program speaks the protocol of docs/base.md";
      break;
    case LinkState::kStreaming:
      return "streaming";
  }
  return text.str();
}

}  // namespace stereo_nav::base
