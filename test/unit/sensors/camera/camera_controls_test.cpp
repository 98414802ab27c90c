// Controls, and the use of a known exposure time.
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <cmath>

#include "unit/sensors/camera/stereo_camera_fixture.h"

namespace stereo_nav::camera {
namespace {

TEST_F(StereoCameraTest, ControlsAreSetByEitherNameAndAgainAfterAReconnection) {
  const auto withControls = [](FakeCamera& camera) {
    camera.controls = {{V4L2_CID_GAIN, "Gain", 0, 100, 0},
                       {V4L2_CID_EXPOSURE_AUTO, "Auto Exposure", 0, 3, 3}};
  };
  kernel_.change(1, withControls);
  auto wanted = config();
  wanted.right.controls = {{"gain", 40}, {"exposure_auto", 1}, {"zoom_absolute", 3}};
  start(wanted);
  ASSERT_TRUE(morePairsCome());
  EXPECT_EQ(kernel_.look(1).controls[0].value, 40);
  EXPECT_EQ(kernel_.look(1).controls[1].value, 1);
  ASSERT_EQ(rig_->right().control_warnings.size(), 1u);
  EXPECT_NE(rig_->right().control_warnings[0].find("zoom_absolute"), std::string::npos);

  rig_->camera().right().setControl("gain", 55);
  rig_->camera().right().setControl("auto_exposure", 0);  // the new name of what was set by its old one
  EXPECT_TRUE(test::waitUntil([this] { return kernel_.look(1).controls[0].value == 55; }));
  kernel_.change(1, [](FakeCamera& camera) {
    camera.dequeue_error = EIO;
    camera.controls[0].value = 0;
    camera.controls[1].value = 3;
  });
  ASSERT_TRUE(rightIsRetrying());
  kernel_.change(1, [](FakeCamera& camera) { camera.dequeue_error = 0; });
  ASSERT_TRUE(morePairsCome());
  EXPECT_EQ(kernel_.look(1).controls[0].value, 55);
  EXPECT_EQ(kernel_.look(1).controls[1].value, 0);
}

TEST_F(StereoCameraTest, StampsMoveToTheMiddleOfAManualExposure) {
  kernel_.change(0, [](FakeCamera& camera) {
    camera.controls = {{V4L2_CID_EXPOSURE_AUTO, "Auto Exposure", 0, 3, 1},
                       {V4L2_CID_EXPOSURE_ABSOLUTE, "Exposure Time, Absolute", 1, 100, 20}};
  });
  start(config());
  ASSERT_TRUE(morePairsCome());
  const auto pairs = rig_->stop();
  // 20 x 100 us = 2 ms, of which the half is 1 ms; the fake stamps the start.
  EXPECT_EQ(pairs.back().pair.left.time_ns - pairs.back().pair.left.stamp_ns, 1'000'000);
  EXPECT_DOUBLE_EQ(pairs.back().pair.left.exposure_s, 0.002);
}

TEST_F(StereoCameraTest, StampsMoveToTheMiddleRowOfARollingShutter) {
  StereoConfig rolling = config();
  rolling.left.rolling_shutter_s = rolling.right.rolling_shutter_s = 0.003;
  start(rolling);
  ASSERT_TRUE(morePairsCome());
  const auto pairs = rig_->stop();
  for (const Frame* frame : {&pairs.back().pair.left, &pairs.back().pair.right}) {
    EXPECT_EQ(frame->time_ns - frame->stamp_ns, 1'500'000);
  }
}

TEST_F(StereoCameraTest, StampsAtTheEndMoveBackToTheMiddleOfTheExposure) {
  kernel_.change(0, [](FakeCamera& camera) {
    camera.stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC | V4L2_BUF_FLAG_TSTAMP_SRC_EOF;
    camera.controls = {{V4L2_CID_EXPOSURE_ABSOLUTE, "Exposure Time, Absolute", 1, 100, 20}};
  });
  start(config());
  ASSERT_TRUE(morePairsCome());
  const auto pairs = rig_->stop();
  EXPECT_EQ(pairs.back().pair.left.time_ns - pairs.back().pair.left.stamp_ns, -1'000'000);
}

TEST_F(StereoCameraTest, AnAutomaticExposureThatTheCameraDoesNotTellIsNotBelieved) {
  kernel_.change(0, [](FakeCamera& camera) {
    camera.controls = {{V4L2_CID_EXPOSURE_AUTO, "Auto Exposure", 0, 3, 3},
                       {V4L2_CID_EXPOSURE_ABSOLUTE, "Exposure Time, Absolute", 1, 100, 20}};
  });
  start(config());
  ASSERT_TRUE(morePairsCome());
  EXPECT_TRUE(rig_->left().exposure_unknown);
  // A control that changes while nobody sets it is in use, whatever the driver's flags say.
  kernel_.change(0, [](FakeCamera& camera) { camera.controls[1].value = 24; });
  EXPECT_TRUE(test::waitUntil([this] { return !rig_->left().exposure_unknown; }));
  ASSERT_TRUE(morePairsCome());
  const auto pairs = rig_->stop();
  EXPECT_TRUE(std::isnan(pairs.front().pair.left.exposure_s));
  EXPECT_DOUBLE_EQ(pairs.back().pair.left.exposure_s, 0.0024);
}

/// The right camera follows the left one's exposure and gain.
class MatchExposureTest : public StereoCameraTest {
 protected:
  /// Sets mode and flags of the left camera; the right one is automatic at first.
  void startWith(std::int32_t mode, std::uint32_t flags) {
    kernel_.change(0, [&](FakeCamera& camera) { camera.controls = controls(mode, 30, flags); });
    kernel_.change(1, [](FakeCamera& camera) { camera.controls = controls(3, 5, 0); });
    auto matched = config();
    matched.match_exposure = true;
    start(matched);
  }
  void setLeft(std::int32_t exposure) {
    kernel_.change(0, [exposure](FakeCamera& camera) {
      camera.controls[0].value = exposure / 2;
      camera.controls[2].value = exposure;
    });
  }
  bool rightGets(std::int32_t gain, std::int32_t exposure) {
    return test::waitUntil([this, gain, exposure] {
      const auto controls = kernel_.look(1).controls;
      return controls[0].value == gain && controls[1].value == V4L2_EXPOSURE_MANUAL &&
             controls[2].value == exposure;
    });
  }

 private:
  static std::vector<FakeCamera::FakeControl> controls(std::int32_t mode, std::int32_t exposure,
                                                       std::uint32_t flags) {
    return {{V4L2_CID_GAIN, "Gain", 0, 100, exposure / 2},
            {V4L2_CID_EXPOSURE_AUTO, "Auto Exposure", 0, 3, mode},
            {V4L2_CID_EXPOSURE_ABSOLUTE, "Exposure Time, Absolute", 1, 100, exposure, flags}};
  }
};

TEST_F(MatchExposureTest, FollowsAManualExposure) {
  startWith(V4L2_EXPOSURE_MANUAL, 0);
  EXPECT_TRUE(rightGets(15, 30));
  setLeft(44);
  EXPECT_TRUE(rightGets(22, 44));
}

TEST_F(MatchExposureTest, FollowsAnAutomaticExposureThatTheCameraTells) {
  startWith(V4L2_EXPOSURE_APERTURE_PRIORITY, V4L2_CTRL_FLAG_VOLATILE);
  EXPECT_TRUE(rightGets(15, 30));
  setLeft(44);
  EXPECT_TRUE(rightGets(22, 44));
}

TEST_F(MatchExposureTest, StaysAutomaticAndSaysSoUntilTheLeftCameraTellsItsExposure) {
  startWith(V4L2_EXPOSURE_APERTURE_PRIORITY, 0);
  EXPECT_TRUE(test::waitUntil([this] { return rig_->log().find("set exposure_ms") != std::string::npos; }));
  EXPECT_EQ(kernel_.look(1).controls[1].value, V4L2_EXPOSURE_APERTURE_PRIORITY);
  setLeft(44);
  EXPECT_TRUE(rightGets(22, 44));
}

}  // namespace
}  // namespace stereo_nav::camera
