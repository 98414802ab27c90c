#include "sensors/imu/frame_decoder.h"

#include <algorithm>

namespace stereo_nav::imu {
namespace {

/// Bits on the wire for a byte: start bit, eight data bits, stop bit.
constexpr double kBitsPerByte = 10.0;

/// Raw frames carry their own time; only a jump of that clock by this much (s) counts as a step.
constexpr double kRawClockStep_s = 0.04;

/// After a silence as long as this, a module that sends no time of its own may have paused ...
constexpr double kSilence_s = 0.5;
/// ... unless about as many bytes have queued as the module sends in that time, up to the size of one read.
constexpr double kQueuedShare = 0.5;
constexpr double kMaxRead = 4096.0;

double byteTime_s(int baud_rate) {
  return kBitsPerByte / baud_rate;
}

class AngleDecoder : public FrameDecoder {
 public:
  AngleDecoder(AngleOrder order, const AngleGateParams& gate, int baud_rate)
      : framer_(order), gate_(gate), byte_time_s_(byteTime_s(baud_rate)) {}

  void push(const std::uint8_t* data, std::size_t size, double read_time_s, const Sink& sink) override {
    if (size == 0) return;
    if (paused(size, read_time_s)) clock_restarted_ = true;
    last_read_s_ = read_time_s;
    for (std::size_t i = 0; i < size; ++i) {
      const auto candidate = framer_.push(data[i]);
      if (!candidate) continue;
      const std::uint64_t last_byte = candidate->first_byte + AngleFramer::kFrameBytes;
      const auto behind = static_cast<double>(framer_.counters().bytes - last_byte + (size - 1 - i));
      gate_.push(*candidate, read_time_s - behind * byte_time_s_,
                 [&](const AngleFrame& frame) { deliver(frame, sink); });
    }
  }

  void reset() override {
    framer_.reset();
    gate_.reset();
    last_index_.reset();
    last_read_s_.reset();
  }

  DecoderCounters counters() const override {
    return {framer_.counters().bytes,
            framer_.counters().bytes_skipped,
            gate_.counters().delivered,
            framer_.counters().impossible + gate_.counters().implausible,
            lost_,
            0};
  }

  double wireTime_s() const override { return AngleFramer::kFrameBytes * byte_time_s_; }

 private:
  /// Whether the module was silent, as opposed to this program having been late.
  bool paused(std::size_t size, double read_time_s) const {
    if (!last_read_s_ || read_time_s - *last_read_s_ < kSilence_s) return false;
    const double sent = AngleFramer::kFrameBytes * (read_time_s - *last_read_s_) / gate_.period_s();
    return static_cast<double>(size) < kQueuedShare * std::min(sent, kMaxRead);
  }

  void deliver(const AngleFrame& frame, const Sink& sink) {
    if (last_index_) lost_ += frame.index - *last_index_ - 1;
    last_index_ = frame.index;
    DecodedFrame decoded;
    decoded.angles = frame.angles;
    decoded.device_clock = static_cast<double>(frame.index);
    decoded.arrival_s = frame.arrival_s;
    decoded.clock_restarted = clock_restarted_;
    clock_restarted_ = false;
    sink(decoded);
  }

  AngleFramer framer_;
  AngleGate gate_;
  double byte_time_s_;
  std::optional<std::uint64_t> last_index_;
  std::optional<double> last_read_s_;
  bool clock_restarted_ = false;
  std::uint64_t lost_ = 0;
};

class RawDecoder : public FrameDecoder {
 public:
  explicit RawDecoder(int baud_rate) : byte_time_s_(byteTime_s(baud_rate)) {}

  void push(const std::uint8_t* data, std::size_t size, double read_time_s, const Sink& sink) override {
    for (std::size_t i = 0; i < size; ++i) {
      const auto frame = parser_.push(data[i]);
      if (!frame) continue;
      const auto behind =
          static_cast<double>(parser_.counters().bytes - 1 - frame->last_byte + (size - 1 - i));
      DecodedFrame decoded;
      decoded.raw = frame->measurement;
      decoded.device_clock = unwrap(frame->measurement.device_time_us);
      decoded.device_clock_step = kRawClockStep_s;
      decoded.arrival_s = read_time_s - behind * byte_time_s_;
      sink(decoded);
    }
  }

  void reset() override {
    parser_.reset();
    last_time_us_.reset();
  }

  DecoderCounters counters() const override {
    const RawParserCounters& c = parser_.counters();
    return {c.bytes, c.bytes_skipped, c.delivered, c.bad_crc + c.impossible, c.lost, 0};
  }

  double wireTime_s() const override { return raw_protocol::kFrameBytes * byte_time_s_; }

 private:
  /// A step back, as after a restart of the module, remains a step back.
  double unwrap(std::uint32_t time_us) {
    if (last_time_us_) time_s_ += static_cast<std::int32_t>(time_us - *last_time_us_) * 1e-6;
    last_time_us_ = time_us;
    return time_s_;
  }

  RawParser parser_;
  double byte_time_s_;
  std::optional<std::uint32_t> last_time_us_;
  double time_s_ = 0.0;
};

}  // namespace

std::unique_ptr<FrameDecoder> makeAngleDecoder(AngleOrder order, const AngleGateParams& gate, int baud_rate) {
  return std::make_unique<AngleDecoder>(order, gate, baud_rate);
}

std::unique_ptr<FrameDecoder> makeRawDecoder(int baud_rate) {
  return std::make_unique<RawDecoder>(baud_rate);
}

}  // namespace stereo_nav::imu
