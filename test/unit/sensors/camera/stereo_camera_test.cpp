#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <chrono>
#include <cmath>
#include <cstring>

#include "unit/sensors/camera/stereo_camera_fixture.h"

namespace stereo_nav::camera {
namespace {

using std::chrono::milliseconds;

TEST_F(StereoCameraTest, PairsCarryTheDriversStampsInOrder) {
  kernel_.change(1, [](FakeCamera& camera) { camera.offset_ns = 1'000'000; });
  start(config());
  ASSERT_TRUE(rig_->pairsCome(100));
  const auto pairs = rig_->stop();
  expectOrdered(pairs);
  for (const auto& images : pairs) {
    const Frame& left = images.pair.left;
    EXPECT_EQ(left.time_ns, left.stamp_ns) << "no exposure is known";
    EXPECT_LE(left.time_ns, left.dequeued_ns);
    EXPECT_EQ(images.pair.timeOffset_ns(), 1'000'000);
    std::uint32_t drawn = 0;
    std::memcpy(&drawn, left.image.pixels.data(), sizeof(drawn));
    EXPECT_EQ(drawn, left.sequence) << "the picture is the one of the stamp";
  }
}

TEST_F(StereoCameraTest, TheLargestSkewCanBeChangedWhileItRuns) {
  kernel_.change(1, [](FakeCamera& camera) { camera.offset_ns = 1'000'000; });
  start(config());
  ASSERT_TRUE(morePairsCome());
  rig_->camera().setMaxTimeOffset(0.0005);
  EXPECT_DOUBLE_EQ(rig_->camera().status().max_time_offset_s, 0.0005);
  const auto aloneSoFar = [this] { return rig_->camera().status().pairing.without_partner[0]; };
  const auto alone = aloneSoFar();
  EXPECT_TRUE(test::waitUntil([&] { return aloneSoFar() > alone + 10; }));
  rig_->camera().setMaxTimeOffset(0.0015);
  EXPECT_TRUE(morePairsCome());
}

TEST_F(StereoCameraTest, CountsEveryFrameOfTheDriver) {
  kernel_.change(0, [](FakeCamera& camera) { camera.lose_every = 7; });
  kernel_.change(1, [](FakeCamera& camera) { camera.break_every = 5; });
  start(config());
  ASSERT_TRUE(rig_->pairsCome(100));
  rig_->stop();
  const auto status = rig_->camera().status();
  const FakeCamera left = kernel_.look(0);
  const FakeCamera right = kernel_.look(1);
  // A gap is known when the frame behind it arrives.
  EXPECT_NEAR(static_cast<double>(status.left.lost), left.frames_lost, 1.0);
  EXPECT_EQ(status.left.frames + status.left.skipped, left.frames_sent);
  EXPECT_EQ(status.right.flagged_broken, right.frames_broken);
  EXPECT_EQ(status.right.frames + status.right.skipped + status.right.flagged_broken, right.frames_sent);
  EXPECT_EQ(status.right.lost, 0u);
}

TEST_F(StereoCameraTest, ASlowReceiverGetsTheNewestPairsAndLossIsCounted) {
  start(config(), milliseconds(30));
  ASSERT_TRUE(rig_->pairsCome(20));
  const auto pairs = rig_->stop();
  expectOrdered(pairs);
  const auto status = rig_->camera().status();
  EXPECT_GT(status.left.skipped + status.right.skipped, 0u);
  EXPECT_EQ(status.left.stalls + status.right.stalls, 0u);
  EXPECT_EQ(status.pairing.pairs, pairs.size() + status.delivered_late) << "none is lost silently";
  // While the receiver has a pair, the cameras go on for seven frames: it gets the newest, not the next.
  const auto frames_between = pairs.back().pair.left.sequence - pairs.front().pair.left.sequence;
  EXPECT_GT(frames_between, 2 * (pairs.size() - 1));
}

/// Where both cameras lost a frame, a pair waits until the next right frame shows that no nearer left one
/// comes; that frame's own partner follows 1.5 ms later, while the receiver still has the first pair.
TEST_F(StereoCameraTest, PairsThatBothCamerasCompleteComeOneByOneInOrder) {
  kernel_.change(0, [](FakeCamera& camera) { camera.lose_every = 2; });
  kernel_.change(1, [](FakeCamera& camera) {
    camera.lose_every = 3;
    camera.offset_ns = 2'500'000;
  });
  auto waiting = config();
  waiting.max_time_offset_s = 0.003;
  start(waiting, milliseconds(15));
  ASSERT_TRUE(rig_->pairsCome(40));
  const auto pairs = rig_->stop();
  expectOrdered(pairs);
  const auto status = rig_->camera().status();
  EXPECT_EQ(status.pairing.pairs, pairs.size() + status.delivered_late);
}

TEST_F(StereoCameraTest, MeasuresTheSlideOfCamerasWhoseRateIsNotTheOneAskedFor) {
  const auto withPeriod = [](std::int64_t period_ns) {
    return [period_ns](FakeCamera& camera) { camera.period_ns = period_ns; };
  };
  kernel_.change(0, withPeriod(10'000'000));
  kernel_.change(1, withPeriod(10'100'000));
  auto faster = config();
  faster.left.format.rate_hz = faster.right.format.rate_hz = 160.0;
  faster.max_time_offset_s = 0.0051;
  start(faster);
  ASSERT_TRUE(rig_->pairsCome(250));  // the skew passes a whole period twice
  // What a busy machine made the pairer miss leaves the fit again.
  double rate = 0.0;
  test::waitUntil([&] {
    rate = rig_->camera().status().time_offset_rate;
    return std::abs(rate - 0.01) <= 0.001;
  });
  EXPECT_NEAR(rate, 0.01, 0.001);
  EXPECT_NE(rig_->log().find("runs at 100 Hz instead of 160"), std::string::npos) << rig_->log();
}

TEST_F(StereoCameraTest, StampsOfAnUnknownClockAreUsedWithAWarning) {
  kernel_.change(0, [](FakeCamera& camera) { camera.stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_COPY; });
  start(config());
  ASSERT_TRUE(morePairsCome());
  EXPECT_NE(rig_->log().find("does not say to which clock"), std::string::npos) << rig_->log();
  EXPECT_NE(rig_->left().clock_warning, "");
  EXPECT_EQ(rig_->right().clock_warning, "");
  for (const auto& images : rig_->stop()) EXPECT_EQ(images.pair.timeOffset_ns(), 0) << "by the stamps";
}

}  // namespace
}  // namespace stereo_nav::camera
