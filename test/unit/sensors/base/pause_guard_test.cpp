#include "sensors/base/pause_guard.h"

#include <gtest/gtest.h>

namespace stereo_nav::base {
namespace {

TEST(PauseGuardTest, BlocksNothingWhileItIsCalledOften) {
  PauseGuard guard;
  EXPECT_FALSE(guard.blocks(99.0)) << "before the first call";
  for (double now_s = 100.0; now_s < 101.0; now_s += 0.02) {
    EXPECT_EQ(guard.tick(now_s), 0.0);
    EXPECT_FALSE(guard.blocks(now_s + 0.01));
  }
  EXPECT_EQ(guard.pauses(), 0U);
}

TEST(PauseGuardTest, BlocksFromThePauseUntilTheSocketsAreEmpty) {
  PauseGuard guard;
  guard.tick(100.0);
  EXPECT_TRUE(guard.blocks(103.0)) << "another thread is first after the pause";
  EXPECT_NEAR(guard.tick(103.0), 3.0, 1e-9);
  EXPECT_TRUE(guard.blocks(103.0));
  EXPECT_EQ(guard.tick(103.09), 0.0);
  EXPECT_TRUE(guard.blocks(103.09));
  EXPECT_FALSE(guard.blocks(103.11));
  EXPECT_EQ(guard.pauses(), 1U);
}

}  // namespace
}  // namespace stereo_nav::base
