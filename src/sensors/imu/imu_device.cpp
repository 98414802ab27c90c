#include "sensors/imu/imu_device.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <sstream>
#include <thread>

namespace stereo_nav::imu {
namespace {

/// Time over which rate and jitter are measured.
constexpr double kReportPeriod_s = 5.0;

}  // namespace

double steadyNow_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void ImuDeviceParams::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "protocol", protocol, {{"angles", Protocol::kAngles}, {"raw", Protocol::kRaw}},
            "what the module sends: three angles, or gyroscope and accelerometer");
  visitor.integer("baud_rate", baud_rate, {300, 12000000}, "baud", "speed of the serial line");
  visitEnum(visitor, "angle_order", angle_order,
            {{"yaw_pitch_roll", AngleOrder::kYawPitchRoll}, {"roll_pitch_yaw", AngleOrder::kRollPitchYaw}},
            "order of the angle module's three numbers");
  visitor.real("latency_s", latency_s, {-1.0, 1.0}, "s",
               "age of a measurement when the module begins to send it; subtracted from the stamps");
  visitor.real("retry_s", retry_s, {0.05, 60.0}, "s", "time between attempts to open the port");
  visitor.real("reopen_silent_s", reopen_silent_s, {0.1, 3600.0}, "s",
               "a port that is silent for this long is opened anew, which some adapters need");
  visitSection(visitor, "gate", gate);
  visitSection(visitor, "stamps", stamps);
}

ImuDevice::ImuDevice(const ImuDeviceParams& params, PortFinder port)
    : params_(params),
      finder_(std::move(port)),
      decoder_(params.protocol == Protocol::kAngles
                   ? makeAngleDecoder(params.angle_order, params.gate, params.baud_rate)
                   : makeRawDecoder(params.baud_rate)),
      stamps_(params.stamps) {}

void ImuDevice::poll(double timeout_s, const Sink& sink) {
  const double now_s = steadyNow_s();
  if (!port_ && now_s >= next_attempt_s_) tryOpen(now_s);
  if (!port_) {
    const double wait_s = std::min(timeout_s, std::max(0.0, next_attempt_s_ - now_s));
    std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
    return;
  }
  try {
    readOnce(timeout_s, sink);
  } catch (const SerialError& error) {
    disconnect(error, steadyNow_s());
  }
}

void ImuDevice::tryOpen(double now_s) {
  next_attempt_s_ = now_s + std::max(params_.retry_s, params_.reopen_silent_s);
  try {
    port_ = std::make_unique<SerialPort>(finder_.locate(), params_.baud_rate);
  } catch (const SerialError& error) {
    disconnect(error, now_s);
    return;
  }
  finder_.remember();
  decoder_->reset();
  stamps_.reset();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!link_.open()) ++status_.connections;
  link_.opened(now_s);
  jitter_.restart();
}

void ImuDevice::disconnect(const SerialError& error, double now_s) {
  port_.reset();
  next_attempt_s_ = now_s + params_.retry_s;
  const std::lock_guard<std::mutex> lock(mutex_);
  link_.closed();
  status_.message = error.what();
}

void ImuDevice::readOnce(double timeout_s, const Sink& sink) {
  std::array<std::uint8_t, 4096> buffer{};
  const std::size_t size = port_->read(buffer.data(), buffer.size(), timeout_s);
  const double now_s = steadyNow_s();
  decoder_->push(buffer.data(), size, now_s, [&](const DecodedFrame& frame) { deliver(frame, sink); });
  const std::lock_guard<std::mutex> lock(mutex_);
  link_.received(size, now_s);
  status_.counters = decoder_->counters();
  if (link_.silentFor_s(now_s) > params_.reopen_silent_s && now_s > next_attempt_s_) {
    port_.reset();
    next_attempt_s_ = now_s;
  }
}

void ImuDevice::deliver(const DecodedFrame& frame, const Sink& sink) {
  ImuReading reading;
  if (frame.clock_restarted) stamps_.restartClock();
  const double sent_s = stamps_.stamp(frame.device_clock, frame.device_clock_step, frame.arrival_s);
  reading.time_s = sent_s - decoder_->wireTime_s() - params_.latency_s;
  reading.angles = frame.angles;
  reading.raw = frame.raw;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    link_.delivered(steadyNow_s());
    jitter_.add(frame.arrival_s, sent_s, frame.device_clock);
    if (jitter_.duration_s() > kReportPeriod_s) {
      status_.rate_hz = jitter_.rate_hz();
      status_.arrival_jitter_s = jitter_.arrivalJitter_s();
      status_.stamp_jitter_s = jitter_.stampJitter_s();
      jitter_.restart();
    }
  }
  sink(reading);
}

ImuDeviceStatus ImuDevice::status() const {
  const double now_s = steadyNow_s();
  const std::lock_guard<std::mutex> lock(mutex_);
  ImuDeviceStatus status = status_;
  status.state = link_.state(now_s);
  if (status.state != LinkState::kStreaming) {
    status.rate_hz = status.arrival_jitter_s = status.stamp_jitter_s = 0.0;
  }
  status.message = explain(status.state, now_s);
  return status;
}

std::string ImuDevice::explain(LinkState state, double now_s) const {
  std::ostringstream text;
  text.precision(3);
  switch (state) {
    case LinkState::kDisconnected:
      return status_.message;
    case LinkState::kWaiting:
      return "connected, waiting for the first frames";
    case LinkState::kSilent:
      text << "no bytes for " << link_.silentFor_s(now_s)
           << " s: is the module powered, its program running, and its TX wired to the adapter's RX?";
      break;
    case LinkState::kNoFrames:
      text << "bytes arrive but no frames: check the baud rate (" << params_.baud_rate
           << " here) and the protocol (" << (params_.protocol == Protocol::kAngles ? "angles" : "raw")
           << " here)";
      break;
    case LinkState::kStreaming:
      return "streaming";
  }
  return text.str();
}

}  // namespace stereo_nav::imu
