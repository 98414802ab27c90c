#include "sensors/laser/scan_decoder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sensors/laser/emulation/emulated_scanner.h"
#include "sensors/serial/emulation/serial_line.h"
#include "unit/sensors/laser/node_stream.h"

namespace stereo_nav::laser {
namespace {

/// A scanner, a line, an adapter and a host that is late by up to a millisecond, in simulated time.
struct Bench {
  ScannerOptions scanner;
  ScanParams scan;
  int baud_rate = 115200;
  double batch_s = 0.016;
  double corrupt = 0.0, drop = 0.0;
};

std::vector<Scan> scansOf(const Bench& setup, double duration_s) {
  EmulatedScanner scanner(setup.scanner);
  serial::SerialLine line(setup.baud_rate, setup.batch_s);
  serial::LineFaults faults(setup.corrupt, setup.drop, 9);
  ScanDecoder decoder(setup.scan, serial::StampFilterParams(), setup.baud_rate, 0.0);
  std::mt19937 random(8);
  std::exponential_distribution<double> host(1.0 / 1e-4);
  std::vector<Scan> scans;
  scanner.receive({0xA5, 0x20}, 0.0);
  for (int step = 0; 1e-3 * step < duration_s; ++step) {
    const double now_s = 1e-3 * step + 1e-6;
    for (const auto& node : scanner.advance(now_s)) {
      Bytes passed;
      faults.pass(node.bytes.data(), node.bytes.size(), passed);
      line.send(passed, node.time_s);
    }
    Bytes bytes;
    line.collect(now_s, bytes);
    decoder.push(bytes.data(), bytes.size(), now_s + std::min(host(random), 1e-3),
                 [&](const Scan& scan) { scans.push_back(scan); });
  }
  return scans;
}

/// The largest error of any beam's time, of the scans from `from_s` on.
double worstTime_s(const std::vector<Scan>& scans, const Bench& setup, double from_s) {
  double worst_s = 0.0;
  for (const Scan& scan : scans) {
    if (scan.time_s < from_s) continue;
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
      const double time_s = scan.time_s + static_cast<double>(i) * scan.time_increment_s;
      const double turns = static_cast<double>(i) / static_cast<double>(scan.ranges_m.size());
      const double error_turns = time_s * setup.scanner.scan_rate_hz - turns;
      worst_s =
          std::max(worst_s, std::abs(error_turns - std::round(error_turns)) / setup.scanner.scan_rate_hz);
    }
  }
  return worst_s;
}

TEST(ScanDecoder, BeamsAreStampedWithinAMillisecond) {
  for (const double scan_rate_hz : {5.5, 10.0}) {
    Bench setup;
    setup.scanner.scan_rate_hz = scan_rate_hz;
    const auto scans = scansOf(setup, 40.0);
    EXPECT_NEAR(static_cast<double>(scans.size()), 40.0 * scan_rate_hz, 3.0);
    const double worst_s = worstTime_s(scans, setup, 3.0);
    EXPECT_LT(worst_s, 1e-3);
    std::cout << scan_rate_hz << " revolutions a second: worst error of a beam's time " << 1e3 * worst_s
              << " ms\n";
    for (const Scan& scan : scans) {
      if (scan.time_s > 3.0) {
        EXPECT_NEAR(scan.scan_time_s, 1.0 / scan_rate_hz, 2e-3);
      }
    }
  }
}

TEST(ScanDecoder, StampsStayOnADamagedLine) {
  Bench setup;
  setup.corrupt = 0.001;
  setup.drop = 0.0005;
  const auto scans = scansOf(setup, 60.0);
  EXPECT_GT(scans.size(), 320U);
  EXPECT_LT(worstTime_s(scans, setup, 3.0), 1e-3);
}

TEST(ScanDecoder, RangesAreThoseOfTheRoomCounterClockwise) {
  Bench setup;
  const EmulatedScanner room(setup.scanner);
  const auto scans = scansOf(setup, 4.0);
  ASSERT_GT(scans.size(), 10U);
  std::size_t present = 0, beams = 0;
  for (const Scan& scan : scans) {
    ASSERT_EQ(scan.ranges_m.size(), 360U);
    for (std::size_t i = 0; i < scan.ranges_m.size(); ++i, ++beams) {
      if (std::isnan(scan.ranges_m[i])) continue;
      ++present;
      // Beam i points at heading i degrees; the node in it is at most half a degree off.
      const double a = room.distance_m(static_cast<double>(i) - 0.52),
                   b = room.distance_m(static_cast<double>(i) + 0.52);
      EXPECT_GE(scan.ranges_m[i], std::min(a, b) - 0.001);
      EXPECT_LE(scan.ranges_m[i], std::max({a, b, room.distance_m(static_cast<double>(i))}) + 0.01);
      EXPECT_EQ(scan.qualities[i], 47.0F);
    }
  }
  EXPECT_GT(static_cast<double>(present), 0.97 * static_cast<double>(beams));
}

TEST(ScanDecoder, WhatIsNoDistanceFollowsRep117) {
  Bench setup;
  setup.scanner.room_length_m = 30.0;  // the walls ahead and behind are out of range
  setup.scanner.room_width_m = 0.2;    // those beside are too near
  const Scan scan = scansOf(setup, 2.0).back();
  EXPECT_EQ(scan.ranges_m[0], std::numeric_limits<float>::infinity());
  EXPECT_EQ(scan.ranges_m[90], -std::numeric_limits<float>::infinity());
  setup.scanner.missing_share = 1.0;
  const Scan nothing = scansOf(setup, 2.0).back();
  for (const float range : nothing.ranges_m) EXPECT_TRUE(std::isnan(range));
}

TEST(ScanDecoder, EightThousandSamplesASecondMakeFinerScans) {
  Bench setup;
  setup.scanner.sample_rate_hz = 8000.0;
  setup.scanner.scan_rate_hz = 10.0;
  setup.scan.beams = 800;
  setup.baud_rate = 460800;
  const auto scans = scansOf(setup, 10.0);
  EXPECT_LT(worstTime_s(scans, setup, 3.0), 1e-3);
  std::size_t missing = 0;
  for (const float range : scans.back().ranges_m) missing += static_cast<std::size_t>(std::isnan(range));
  EXPECT_LT(missing, 20U);
}

}  // namespace
}  // namespace stereo_nav::laser
