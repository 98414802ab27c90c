#include "sensors/base/controller/tfmini.h"

#include <gtest/gtest.h>

namespace stereo_nav::base {
namespace {

/// The range finder of the firmware, with the limits of a TFmini Plus.
class ControllerTfminiTest : public testing::Test {
 protected:
  std::uint16_t give(std::uint16_t distance_cm, std::uint16_t strength, std::uint8_t damage = 0) {
    std::uint8_t frame[9] = {0x59,
                             0x59,
                             static_cast<std::uint8_t>(distance_cm),
                             static_cast<std::uint8_t>(distance_cm >> 8),
                             static_cast<std::uint8_t>(strength),
                             static_cast<std::uint8_t>(strength >> 8),
                             0x10,
                             0x09,
                             0};
    for (int i = 0; i < 8; ++i) frame[8] = static_cast<std::uint8_t>(frame[8] + frame[i]);
    frame[8] = static_cast<std::uint8_t>(frame[8] + damage);
    for (const std::uint8_t byte : frame) finder_.receive(byte, now_ms_);
    return finder_.range_mm(now_ms_);
  }

  Tfmini finder_{TfminiLimits{100, 12000, 100}};
  std::uint32_t now_ms_ = 0xFFFFFFC0U;  // the clock wraps in the test of silence
};

TEST_F(ControllerTfminiTest, JudgesAsRangeBridgeDoes) {
  EXPECT_EQ(finder_.range_mm(now_ms_), kRangeUnknown) << "before the first frame";
  EXPECT_EQ(give(150, 2000), 1500);
  EXPECT_EQ(give(9, 2000), kRangeTooNear);
  EXPECT_EQ(give(1201, 2000), kRangeNothing);
  EXPECT_EQ(give(150, 99), kRangeNothing) << "too little light";
  EXPECT_EQ(give(150, 65535), kRangeUnknown) << "dazzled";
  for (const int code : {65532, 65533, 65534, 65535})
    EXPECT_EQ(give(static_cast<std::uint16_t>(code), 2000), kRangeUnknown) << code;
}

TEST_F(ControllerTfminiTest, AnOldDistanceIsForgotten) {
  EXPECT_EQ(give(150, 2000), 1500);
  now_ms_ += 200;
  EXPECT_EQ(finder_.range_mm(now_ms_), 1500);
  now_ms_ += 1;
  EXPECT_EQ(give(150, 2000, 1), kRangeUnknown) << "a damaged frame does not count";
  now_ms_ += 10;
  EXPECT_EQ(give(200, 2000), 2000);
}

}  // namespace
}  // namespace stereo_nav::base
