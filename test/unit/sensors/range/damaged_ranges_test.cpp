#include <gtest/gtest.h>

#include <iostream>

#include "sensors/serial/emulation/serial_line.h"
#include "unit/sensors/range/range_stream.h"

namespace stereo_nav::range {
namespace {

/// A million frames over a line that changes and loses bytes.
TEST(DamagedRangeStream, OfAMillionFramesTheIntactOnesArrive) {
  constexpr std::uint64_t kMillion = 1000000;
  serial::LineFaults faults(0.002, 0.001, 11);
  TfminiParser parser;
  std::uint64_t intact = 0, right = 0, wrong = 0;
  for (std::uint64_t k = 0; k < kMillion; ++k) {
    const Bytes sent = bytesOf(k);
    Bytes received;
    intact += static_cast<std::uint64_t>(faults.pass(sent.data(), sent.size(), received));
    for (const TfminiFrame& frame : parsed(parser, received)) {
      const bool sent_lately = same(frame.measurement, measurementOf(k)) ||
                               (k > 0 && same(frame.measurement, measurementOf(k - 1)));
      ++(sent_lately ? right : wrong);
    }
  }
  std::cout << "intact frames delivered: " << 100.0 * static_cast<double>(right) / static_cast<double>(intact)
            << " %, wrong ones: " << wrong << "\n";
  EXPECT_GT(static_cast<double>(right), 0.97 * static_cast<double>(intact));
  EXPECT_LT(wrong, 30U) << "two damaged bytes pass a check sum of eight bits now and then";
}

}  // namespace
}  // namespace stereo_nav::range
