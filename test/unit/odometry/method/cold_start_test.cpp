#include "support/cold_start.h"

#include <gtest/gtest.h>

namespace stereo_nav::test {
namespace {

/// Two of each kind with an IMU, one without; build/devel/lib/stereo_nav/vo_cold_starts_test runs a hundred.
TEST(ColdStart, WhatIsCalledTrackingIsWhereItsCovarianceSays) {
  ColdStartCounts all;
  for (int number = 0; number < 3 * ColdStart::kKinds; ++number) {
    const ColdStart start(number);
    const ColdStartCounts counts = start.run();
    EXPECT_EQ(counts.begun, 1) << start.text();
    EXPECT_EQ(counts.beyond, 0) << start.text() << ": " << counts.worst;
    EXPECT_EQ(counts.wrong, 0) << start.text();
    all += counts;
  }
  EXPECT_LE(200 * all.outside, all.tracking);
  EXPECT_GT(2 * all.tracking, all.frames);
}

}  // namespace
}  // namespace stereo_nav::test
