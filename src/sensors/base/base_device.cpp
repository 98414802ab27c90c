#include "sensors/base/base_device.h"

#include <array>
#include <string>

#include "sensors/serial/steady_clock.h"

namespace stereo_nav::base {
namespace {

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
      link_(params.link, params.stamps, [this] { return open(); }) {}

std::shared_ptr<serial::ByteSource> BaseDevice::open() {
  auto port = std::make_shared<serial::SerialPort>(finder_.locate(), params_.baud_rate);
  finder_.remember();
  decoder_.reset();
  port_ = port;
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
  const double sent_s = link_.stamp(frame.device_clock_s, kClockStep_s, frame.arrival_s);
  reading.time_s = sent_s - frame.wire_s - params_.latency_s;
  reading.arrival_s = frame.arrival_s;
  reading.telemetry = frame.telemetry;
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
  const serial::DeviceStatus link = link_.status(words());
  const std::lock_guard<std::mutex> lock(mutex_);
  BaseDeviceStatus status = status_;
  static_cast<serial::DeviceStatus&>(status) = link;
  return status;
}

serial::LinkWords BaseDevice::words() const {
  serial::LinkWords words;
  words.waiting = "connected, waiting for the first telemetry";
  words.silent = ": is the controller powered, its program running, and its TX wired to the adapter's RX?";
  words.no_frames = "bytes arrive but no telemetry: check the baud rate (" +
                    std::to_string(params_.baud_rate) +
                    " here) and that the controller's program speaks the protocol of docs/base.md";
  words.streaming = "streaming";
  return words;
}

}  // namespace stereo_nav::base
