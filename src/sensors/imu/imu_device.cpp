#include "sensors/imu/imu_device.h"

#include <array>
#include <string>

#include "sensors/serial/serial_port.h"
#include "sensors/serial/steady_clock.h"

namespace stereo_nav::imu {
namespace {

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
      link_(params.link, params.stamps, [this] { return open(); }) {}

std::shared_ptr<serial::ByteSource> ImuDevice::open() {
  std::shared_ptr<serial::ByteSource> source;
  if (udp_) {
    source = std::make_shared<UdpSource>(*udp_);
  } else {
    source = std::make_shared<serial::SerialPort>(finder_.locate(), params_.baud_rate);
    finder_.remember();
  }
  decoder_->reset();
  return source;
}

void ImuDevice::poll(double timeout_s, const Sink& sink) {
  std::array<std::uint8_t, 4096> buffer{};
  const std::size_t size = link_.read(buffer.data(), buffer.size(), timeout_s);
  decoder_->push(buffer.data(), size, serial::steadyNow_s(),
                 [&](const DecodedFrame& frame) { deliver(frame, sink); });
  const std::lock_guard<std::mutex> lock(mutex_);
  counters_ = decoder_->counters();
}

void ImuDevice::deliver(const DecodedFrame& frame, const Sink& sink) {
  ImuReading reading;
  if (frame.clock_restarted) link_.restartClock();
  const double sent_s = link_.stamp(frame.device_clock, frame.device_clock_step, frame.arrival_s);
  reading.time_s = sent_s - decoder_->wireTime_s() - params_.latency_s;
  reading.angles = frame.angles;
  reading.raw = frame.raw;
  sink(reading);
}

ImuDeviceStatus ImuDevice::status() const {
  const serial::DeviceStatus link = link_.status(words());
  const std::lock_guard<std::mutex> lock(mutex_);
  return {link, counters_};
}

serial::LinkWords ImuDevice::words() const {
  if (udp_) return wordsOfUdp();
  serial::LinkWords words;
  words.waiting = "connected, waiting for the first frames";
  words.silent = ": is the module powered, its program running, and its TX wired to the adapter's RX?";
  words.no_frames = "bytes arrive but no frames: check the baud rate (" + std::to_string(params_.baud_rate) +
                    " here) and the protocol (" + (params_.protocol == Protocol::kAngles ? "angles" : "raw") +
                    " here)";
  words.streaming = "streaming";
  return words;
}

serial::LinkWords ImuDevice::wordsOfUdp() const {
  const bool here_only = udp_->host.rfind("127.", 0) == 0;
  serial::LinkWords words;
  words.silence = "no datagrams for";
  words.waiting = "waiting for the first datagrams on " + udp_->text();
  words.silent = " on " + udp_->text() +
                 ": is the stream on, and to this computer's address and this port? " +
                 (here_only ? "Only this computer is heard: port udp:0.0.0.0:" + std::to_string(udp_->port) +
                                  " hears the network, too"
                            : "Does a firewall keep them away?");
  words.no_frames = std::string("datagrams arrive, but no measurements: check the protocol (") +
                    (params_.protocol == Protocol::kPhone ? "phone" : "raw") +
                    " here), and that gyroscope and accelerometer are switched on in the app";
  words.streaming = "streaming";
  return words;
}

}  // namespace stereo_nav::imu
