#include <algorithm>
#include <cmath>

#include "sensors/imu/frame_decoder.h"
#include "sensors/imu/phone_protocol.h"

namespace stereo_nav::imu {
namespace {

/// A device time that is older than the newest one by less than this belongs to a datagram that was
/// overtaken; by more, the phone or its program was started again.
constexpr double kOvertaken_s = 1.0;
/// Networks delay by tens of milliseconds: only a jump of the device's clock by this much (s) counts as a
/// step.
constexpr double kClockStep_s = 0.4;
/// A larger gap in the sequence means that the device was restarted.
constexpr std::uint16_t kRestartGap = 10000;
/// Share of a new interval in the smoothed period of a phone.
constexpr double kPeriodGain = 0.05;

/// What both protocols have in common: datagrams come late, twice or never, and each stands for itself.
class DatagramDecoder : public FrameDecoder {
 public:
  void push(const std::uint8_t* data, std::size_t size, double read_time_s, const Sink& sink) override {
    if (size == 0) return;
    counters_.bytes += size;
    read(data, size, read_time_s, sink);
  }

  void reset() override { newest_s_.reset(); }
  DecoderCounters counters() const override { return counters_; }
  double wireTime_s() const override { return 0.0; }

 protected:
  /// Reads one datagram and passes what it holds to accept().
  virtual void read(const std::uint8_t* data, std::size_t size, double read_time_s, const Sink& sink) = 0;

  /// Whether the measurement is newer than all before it. A step back by more begins a new stream.
  bool isNewer(double device_time_s) {
    if (newest_s_ && device_time_s <= *newest_s_ && device_time_s > *newest_s_ - kOvertaken_s) {
      ++counters_.late_frames;
      return false;
    }
    return true;
  }

  void deliver(const RawMeasurement& measurement, double device_time_s, double read_time_s,
               const Sink& sink) {
    DecodedFrame frame;
    frame.raw = measurement;
    frame.device_clock = device_time_s;
    frame.device_clock_step = kClockStep_s;
    frame.arrival_s = read_time_s;
    newest_s_ = device_time_s;
    ++counters_.frames;
    sink(frame);
  }

  DecoderCounters counters_;
  std::optional<double> newest_s_;  ///< device time of the newest measurement
};

class RawDatagramDecoder : public DatagramDecoder {
  /// A datagram holds whole frames.
  void read(const std::uint8_t* data, std::size_t size, double read_time_s, const Sink& sink) override {
    RawParser parser;
    for (std::size_t i = 0; i < size; ++i) {
      if (const auto frame = parser.push(data[i])) accept(frame->measurement, read_time_s, sink);
    }
    const RawParserCounters& parsed = parser.counters();
    counters_.bad_frames +=
        std::max<std::uint64_t>(parsed.bad_crc + parsed.impossible, parsed.delivered == 0 ? 1 : 0);
    counters_.bytes_skipped += parsed.delivered == 0 ? size : parsed.bytes_skipped;
  }

  void accept(const RawMeasurement& measurement, double read_time_s, const Sink& sink) {
    const double time_s = unwrapped(measurement.device_time_us);
    if (!isNewer(time_s)) return;
    const auto gap = static_cast<std::uint16_t>(measurement.sequence - newest_sequence_ - 1);
    if (newest_s_ && gap < kRestartGap) counters_.lost_frames += gap;
    newest_sequence_ = measurement.sequence;
    newest_us_ = measurement.device_time_us;
    deliver(measurement, time_s, read_time_s, sink);
  }

  /// The time of 32 bits, continued from the newest one, of either sign.
  double unwrapped(std::uint32_t time_us) const {
    if (!newest_s_) return 0.0;
    return *newest_s_ + static_cast<std::int32_t>(time_us - newest_us_) * 1e-6;
  }

  std::uint32_t newest_us_ = 0;
  std::uint16_t newest_sequence_ = 0;
};

class PhoneDecoder : public DatagramDecoder {
  void read(const std::uint8_t* data, std::size_t size, double read_time_s, const Sink& sink) override {
    const auto sample = parsePhoneText(data, size);
    if (!sample) {
      ++counters_.bad_frames;
      counters_.bytes_skipped += size;
      return;
    }
    if (!isNewer(sample->time_s)) return;
    if (newest_s_ && sample->time_s > *newest_s_) countLost(sample->time_s - *newest_s_);
    deliver(sample->measurement, sample->time_s, read_time_s, sink);
  }

  /// Phones number nothing: losses are told by the even rate at which they measure.
  void countLost(double interval_s) {
    if (period_s_ > 0.0 && interval_s > 1.5 * period_s_ && interval_s < kOvertaken_s) {
      counters_.lost_frames += static_cast<std::uint64_t>(std::lround(interval_s / period_s_)) - 1;
    } else if (interval_s < kOvertaken_s) {
      period_s_ += period_s_ > 0.0 ? kPeriodGain * (interval_s - period_s_) : interval_s;
    }
  }

  double period_s_ = 0.0;  ///< smoothed; 0: not known yet
};

}  // namespace

std::unique_ptr<FrameDecoder> makeRawDatagramDecoder() {
  return std::make_unique<RawDatagramDecoder>();
}

std::unique_ptr<FrameDecoder> makePhoneDecoder() {
  return std::make_unique<PhoneDecoder>();
}

}  // namespace stereo_nav::imu
