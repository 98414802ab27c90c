#include "sensors/range/range_device.h"

#include <array>
#include <limits>
#include <string>

#include "sensors/serial/serial_port.h"
#include "sensors/serial/steady_clock.h"

namespace stereo_nav::range {
namespace {

/// Bits on the wire for a byte: start bit, eight data bits, stop bit.
constexpr double kBitsPerByte = 10.0;
/// After a silence as long as this, the device may have paused: frames have no number.
constexpr double kPause_s = 0.5;
constexpr std::uint16_t kDazzled = 65535;

}  // namespace

void RangeDeviceParams::describe(ParameterVisitor& visitor) {
  visitor.integer("baud_rate", baud_rate, {300, 12000000}, "baud", "speed of the serial line");
  visitor.real("range_min_m", range_min_m, {0.0, 100.0}, "m", "nearer measurements become -Inf (REP-117)");
  visitor.real("range_max_m", range_max_m, {0.1, 100.0}, "m", "farther measurements become +Inf (REP-117)");
  visitor.integer("min_strength", min_strength, {0, 65534}, "",
                  "with less light than this nothing is within reach: +Inf (REP-117)");
  visitor.real("latency_s", latency_s, {-1.0, 1.0}, "s",
               "age of a measurement when the module begins to send it; subtracted from the stamps");
  link.describe(visitor);
  visitSection(visitor, "stamps", stamps);
}

double rangeOf(const TfminiMeasurement& measurement, const RangeDeviceParams& params) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  if (measurement.strength == kDazzled) return kNan;
  if (measurement.strength < params.min_strength) return kInfinity;
  if (measurement.distance_cm >= tfmini::kFirstCode) return kNan;
  const double range_m = 0.01 * measurement.distance_cm;
  if (range_m < params.range_min_m) return -kInfinity;
  return range_m > params.range_max_m ? kInfinity : range_m;
}

RangeDevice::RangeDevice(const RangeDeviceParams& params, serial::PortFinder port)
    : params_(params),
      finder_(std::move(port)),
      link_(params.link, params.stamps, [this] { return open(); }) {}

std::shared_ptr<serial::ByteSource> RangeDevice::open() {
  auto port = std::make_shared<serial::SerialPort>(finder_.locate(), params_.baud_rate);
  finder_.remember();
  parser_.reset();
  return port;
}

void RangeDevice::poll(double timeout_s, const Sink& sink) {
  std::array<std::uint8_t, 4096> buffer{};
  const std::size_t size = link_.read(buffer.data(), buffer.size(), timeout_s);
  const double now_s = serial::steadyNow_s();
  for (std::size_t i = 0; i < size; ++i) {
    const auto frame = parser_.push(buffer[i]);
    if (!frame) continue;
    const auto behind = static_cast<double>(parser_.counters().bytes - 1 - frame->last_byte + (size - 1 - i));
    deliver(*frame, now_s - behind * kBitsPerByte / params_.baud_rate, sink);
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.counters = parser_.counters();
}

void RangeDevice::deliver(const TfminiFrame& frame, double arrival_s, const Sink& sink) {
  if (arrival_s - last_arrival_s_ > kPause_s) link_.restartClock();
  last_arrival_s_ = arrival_s;
  const double sent_s = link_.stamp(static_cast<double>(frame.index), 1.0, arrival_s);
  const double wire_s = tfmini::kFrameBytes * kBitsPerByte / params_.baud_rate;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    status_.last = frame.measurement;
  }
  sink({sent_s - wire_s - params_.latency_s, rangeOf(frame.measurement, params_), frame.measurement});
}

RangeDeviceStatus RangeDevice::status() const {
  const serial::DeviceStatus link = link_.status(words());
  const std::lock_guard<std::mutex> lock(mutex_);
  RangeDeviceStatus status = status_;
  static_cast<serial::DeviceStatus&>(status) = link;
  return status;
}

serial::LinkWords RangeDevice::words() const {
  serial::LinkWords words;
  words.waiting = "connected, waiting for the first frames";
  words.silent = ": is the range finder powered with 5 V, and its TX wired to the adapter's RX?";
  words.no_frames = "bytes arrive but no frames: check the baud rate (" + std::to_string(params_.baud_rate) +
                    " here) and that the range finder sends its standard format, not text";
  words.streaming = "measuring";
  return words;
}

}  // namespace stereo_nav::range
