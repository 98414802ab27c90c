#include "fuzz/device_fuzz.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>

#include "fuzz/base_fuzz.h"
#include "sensors/imu/frame_decoder.h"
#include "sensors/laser/rplidar_session.h"
#include "sensors/laser/scan_decoder.h"
#include "sensors/range/range_device.h"

namespace stereo_nav {
namespace {

constexpr int kFuzzBaud = 115200;

void require(bool condition) {
  if (!condition) std::abort();
}

using Read = std::function<void(const std::uint8_t* data, std::size_t size, double now_s)>;

/// Returns how many bytes were passed on.
std::size_t cutIntoReads(const std::uint8_t* data, std::size_t size, const Read& read) {
  if (size == 0) return 0;
  const std::size_t piece = 1 + data[0] % 40 * (data[0] % 40);
  const double pause_s = data[0] / 40 * 0.004;
  double now_s = 0.0;
  for (std::size_t i = 1; i < size; i += piece) {
    read(data + i, std::min(piece, size - i), now_s);
    now_s += pause_s;
  }
  return size - 1;
}

void checkFrame(const imu::DecodedFrame& frame) {
  require(frame.angles.has_value() != frame.raw.has_value());
  require(std::isfinite(frame.device_clock) && std::isfinite(frame.arrival_s));
  if (frame.angles) {
    require(frame.angles->vector().allFinite() && frame.angles->vector().cwiseAbs().maxCoeff() < 361);
  }
  if (frame.raw) require(imu::raw_protocol::possible(*frame.raw));
}

void decodeImu(imu::FrameDecoder& decoder, const std::uint8_t* data, std::size_t size) {
  const std::size_t bytes =
      cutIntoReads(data, size, [&](const std::uint8_t* part, std::size_t count, double now_s) {
        decoder.push(part, count, now_s, checkFrame);
      });
  const imu::DecoderCounters counters = decoder.counters();
  require(counters.bytes == bytes && counters.bytes_skipped <= counters.bytes * 20);
}

void checkScan(const laser::Scan& scan, const laser::ScanParams& params) {
  require(scan.ranges_m.size() == static_cast<std::size_t>(params.beams));
  require(scan.qualities.size() == scan.ranges_m.size());
  require(std::isfinite(scan.time_s) && std::isfinite(scan.scan_time_s));
  for (const float range_m : scan.ranges_m) {
    require(!std::isfinite(range_m) || (range_m >= static_cast<float>(params.range_min_m) &&
                                        range_m <= static_cast<float>(params.range_max_m)));
  }
}

/// The session takes what it awaits, whatever that is; then the scan begins.
void decodeLaser(const std::uint8_t* data, std::size_t size) {
  laser::ScanParams params;
  params.beams = 36;
  laser::RplidarSession session([](laser::rplidar::Command) {});
  laser::ScanDecoder decoder(params, serial::StampFilterParams(), kFuzzBaud, 0.0);
  session.begin(-1.0);
  const std::size_t bytes =
      cutIntoReads(data, size, [&](const std::uint8_t* part, std::size_t count, double now_s) {
        require(session.update(part, count, now_s) <= count);
        decoder.push(part, count, now_s, [&](const laser::Scan& scan) { checkScan(scan, params); });
      });
  const laser::NodeFramerCounters& counters = decoder.counters();
  require(counters.bytes == bytes && counters.bytes_skipped + 5 * counters.nodes <= counters.bytes);
}

void parseTfmini(const std::uint8_t* data, std::size_t size) {
  const range::RangeDeviceParams params;
  range::TfminiParser parser;
  std::uint64_t last_index = 0;
  const std::size_t bytes =
      cutIntoReads(data, size, [&](const std::uint8_t* part, std::size_t count, double /*now_s*/) {
        for (std::size_t i = 0; i < count; ++i) {
          const auto frame = parser.push(part[i]);
          if (!frame) continue;
          const double range_m = range::rangeOf(frame->measurement, params);
          require(!std::isfinite(range_m) ||
                  (range_m >= params.range_min_m && range_m <= params.range_max_m));
          require(frame->index > last_index && frame->last_byte < parser.counters().bytes);
          last_index = frame->index;
        }
      });
  const range::TfminiCounters& counters = parser.counters();
  require(counters.bytes == bytes && counters.bytes_skipped + 9 * counters.frames <= counters.bytes);
}

}  // namespace

bool decodeFuzzInput(const std::string& kind, const std::uint8_t* data, std::size_t size) {
  if (kind == "angles") {
    decodeImu(*imu::makeAngleDecoder(imu::AngleOrder::kYawPitchRoll, imu::AngleGateParams(), kFuzzBaud), data,
              size);
  } else if (kind == "raw") {
    decodeImu(*imu::makeRawDecoder(kFuzzBaud), data, size);
  } else if (kind == "raw_udp") {
    decodeImu(*imu::makeRawDatagramDecoder(), data, size);
  } else if (kind == "phone") {
    decodeImu(*imu::makePhoneDecoder(), data, size);
  } else if (kind == "laser") {
    decodeLaser(data, size);
  } else if (kind == "tfmini") {
    parseTfmini(data, size);
  } else if (kind == "base") {
    base::parseFuzzInput(data, size);
  } else {
    return false;
  }
  return true;
}

}  // namespace stereo_nav
