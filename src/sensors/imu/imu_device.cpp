#include "sensors/imu/imu_device.h"

#include <array>
#include <sstream>

#include "sensors/serial/serial_port.h"
#include "sensors/serial/steady_clock.h"

namespace stereo_nav::imu {
namespace {

/// Time over which rate and jitter are measured.
constexpr double kReportPeriod_s = 5.0;

std::unique_ptr<FrameDecoder> makeDecoder(const ImuDeviceParams& params, bool udp) {
  if (params.protocol == Protocol::kAngles) {
    if (udp)
      throw ParameterError("protocol: angles come over a serial port, not over UDP; choose raw or phone");
    return makeAngleDecoder(params.angle_order, params.gate, params.baud_rate);
  }
  if (params.protocol == Protocol::kRaw) {
    return udp ? makeRawDatagramDecoder() : makeRawDecoder(params.baud_rate);
  }
  if (!udp)
    throw ParameterError(
        "protocol: a phone sends UDP; set port to udp:0.0.0.0:5555, or to udp:5555 for this "
        "computer alone");
  return makePhoneDecoder();
}

}  // namespace

void ImuDeviceParams::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "protocol", protocol,
            {{"angles", Protocol::kAngles}, {"raw", Protocol::kRaw}, {"phone", Protocol::kPhone}},
            "what the module sends: three angles, gyroscope and accelerometer, or a phone's text over UDP");
  visitor.integer("baud_rate", baud_rate, {300, 12000000}, "baud", "speed of the serial line");
  visitEnum(visitor, "angle_order", angle_order,
            {{"yaw_pitch_roll", AngleOrder::kYawPitchRoll}, {"roll_pitch_yaw", AngleOrder::kRollPitchYaw}},
            "order of the angle module's three numbers");
  visitor.real("latency_s", latency_s, {-1.0, 1.0}, "s",
               "age of a measurement when the module begins to send it; subtracted from the stamps");
  link.describe(visitor);
  visitSection(visitor, "gate", gate);
  visitSection(visitor, "stamps", stamps);
}

ImuDevice::ImuDevice(const ImuDeviceParams& params, serial::PortFinder port)
    : params_(params),
      finder_(std::move(port)),
      udp_(parseUdpAddress(finder_.locate())),
      decoder_(makeDecoder(params, udp_.has_value())),
      stamps_(params.stamps),
      link_(params.link, [this] { return open(); }) {}

std::shared_ptr<serial::ByteSource> ImuDevice::open() {
  std::shared_ptr<serial::ByteSource> source;
  if (udp_) {
    source = std::make_shared<UdpSource>(*udp_);
  } else {
    source = std::make_shared<serial::SerialPort>(finder_.locate(), params_.baud_rate);
    finder_.remember();
  }
  decoder_->reset();
  stamps_.reset();
  const std::lock_guard<std::mutex> lock(mutex_);
  jitter_.restart();
  return source;
}

void ImuDevice::poll(double timeout_s, const Sink& sink) {
  std::array<std::uint8_t, 4096> buffer{};
  const std::size_t size = link_.read(buffer.data(), buffer.size(), timeout_s);
  decoder_->push(buffer.data(), size, serial::steadyNow_s(),
                 [&](const DecodedFrame& frame) { deliver(frame, sink); });
  const std::lock_guard<std::mutex> lock(mutex_);
  status_.counters = decoder_->counters();
}

void ImuDevice::deliver(const DecodedFrame& frame, const Sink& sink) {
  ImuReading reading;
  if (frame.clock_restarted) stamps_.restartClock();
  const double sent_s = stamps_.stamp(frame.device_clock, frame.device_clock_step, frame.arrival_s);
  reading.time_s = sent_s - decoder_->wireTime_s() - params_.latency_s;
  reading.angles = frame.angles;
  reading.raw = frame.raw;
  link_.delivered();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
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
  const serial::LinkStatus link = link_.status();
  const std::lock_guard<std::mutex> lock(mutex_);
  ImuDeviceStatus status = status_;
  status.state = link.state;
  status.connections = link.connections;
  if (status.state != serial::LinkState::kStreaming) {
    status.rate_hz = status.arrival_jitter_s = status.stamp_jitter_s = 0.0;
  }
  status.message = explain(link);
  return status;
}

std::string ImuDevice::explain(const serial::LinkStatus& link) const {
  using serial::LinkState;
  if (udp_) return explainUdp(link);
  std::ostringstream text;
  text.precision(3);
  switch (link.state) {
    case LinkState::kDisconnected:
      return link.fault;
    case LinkState::kWaiting:
      return "connected, waiting for the first frames";
    case LinkState::kSilent:
      text << "no bytes for " << link.silent_s
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

std::string ImuDevice::explainUdp(const serial::LinkStatus& link) const {
  using serial::LinkState;
  std::ostringstream text;
  text.precision(3);
  switch (link.state) {
    case LinkState::kDisconnected:
      return link.fault;
    case LinkState::kWaiting:
      return "waiting for the first datagrams on " + udp_->text();
    case LinkState::kSilent:
      text << "no datagrams for " << link.silent_s << " s on " << udp_->text()
           << ": is the stream on, and to this computer's address and this port? ";
      text << (udp_->host.rfind("127.", 0) == 0 ? "Only this computer is heard: port udp:0.0.0.0:" +
                                                      std::to_string(udp_->port) + " hears the network, too"
                                                : std::string("Does a firewall keep them away?"));
      break;
    case LinkState::kNoFrames:
      text << "datagrams arrive, but no measurements: check the protocol ("
           << (params_.protocol == Protocol::kPhone ? "phone" : "raw")
           << " here), and that gyroscope and accelerometer are switched on in the app";
      break;
    case LinkState::kStreaming:
      return "streaming";
  }
  return text.str();
}

}  // namespace stereo_nav::imu
