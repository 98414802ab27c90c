#include "nodes/cmd_vel_mux/velocity_mux.h"

#include <gtest/gtest.h>

namespace stereo_nav::nodes {
namespace {

enum Source : std::size_t { kStop, kManual, kAuto };

VelocityMux stopManualAuto() {
  return VelocityMux({{"cmd_vel_stop", 0.5, true}, {"cmd_vel_manual", 0.3}, {"cmd_vel_auto", 0.2}});
}

TEST(VelocityMuxTest, NothingIsActiveBeforeTheFirstMessage) {
  EXPECT_FALSE(stopManualAuto().active(0.0).has_value());
}

TEST(VelocityMuxTest, TheHigherRankKeepsTheLowerOnesOutForItsTimeOut) {
  VelocityMux mux = stopManualAuto();
  EXPECT_TRUE(mux.offer(kAuto, 0.0));
  EXPECT_TRUE(mux.offer(kManual, 0.1));
  EXPECT_FALSE(mux.offer(kAuto, 0.2));
  EXPECT_FALSE(mux.offer(kAuto, 0.399));
  EXPECT_TRUE(mux.offer(kAuto, 0.401));
  EXPECT_TRUE(mux.offer(kStop, 0.5));
  EXPECT_FALSE(mux.offer(kManual, 0.6));
  EXPECT_FALSE(mux.offer(kAuto, 0.6));
  EXPECT_EQ(mux.active(0.6), kStop);
  EXPECT_TRUE(mux.offer(kManual, 1.01));
  EXPECT_EQ(mux.dropped(kAuto), 3U);
  EXPECT_EQ(mux.dropped(kManual), 1U);
  EXPECT_EQ(mux.passed(kManual), 2U);
}

TEST(VelocityMuxTest, ALowerSourceGoesOnWhenTheHigherOneFallsSilent) {
  VelocityMux mux = stopManualAuto();
  mux.offer(kManual, 0.0);
  mux.offer(kAuto, 0.25);
  EXPECT_EQ(mux.active(0.29), kManual);
  EXPECT_EQ(mux.active(0.31), kAuto);
  EXPECT_FALSE(mux.active(0.46).has_value());
}

TEST(VelocityMuxTest, AfterAPauseOnlyStopsPassUntilTheSocketsAreEmpty) {
  VelocityMux mux = stopManualAuto();
  mux.tick(0.0);
  EXPECT_TRUE(mux.offer(kManual, 0.01));
  EXPECT_EQ(mux.tick(0.02), 0.0);
  EXPECT_FALSE(mux.offer(kManual, 0.17)) << "it waited in the socket; the timer comes later";
  EXPECT_NEAR(mux.tick(0.17), 0.15, 1e-9);
  EXPECT_FALSE(mux.active(0.17).has_value()) << "though it was heard 0.16 s ago";
  EXPECT_FALSE(mux.offer(kAuto, 0.2));
  EXPECT_FALSE(mux.active(0.2).has_value());
  EXPECT_TRUE(mux.offer(kStop, 0.21));
  EXPECT_EQ(mux.tick(0.26), 0.0);
  EXPECT_FALSE(mux.offer(kManual, 0.28)) << "after the stop";
  EXPECT_EQ(mux.dropped(kManual), 2U);
}

TEST(VelocityMuxTest, VelocitiesPassAgainAMomentAfterAPause) {
  VelocityMux mux = stopManualAuto();
  mux.tick(0.0);
  mux.tick(3.0);
  EXPECT_FALSE(mux.offer(kAuto, 3.05));
  mux.tick(3.06);
  mux.tick(3.12);
  EXPECT_TRUE(mux.offer(kAuto, 3.13));
}

}  // namespace
}  // namespace stereo_nav::nodes
