#include "stereo_nav/capture/stereo_camera.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <thread>

#include "unit/capture/fake_kernel.h"
#include "unit/capture/stereo_rig.h"

namespace stereo_nav::capture {
namespace {

using std::chrono::milliseconds;

/// Two fake cameras on ports 1 and 2, captured by the real threads.
class StereoCameraTest : public testing::Test {
 protected:
  StereoCameraTest() {
    FakeCamera left, right;
    left.bus_info = "usb-fake-1";
    right.bus_info = "usb-fake-2";
    kernel_.plugIn(0, left);
    kernel_.plugIn(1, right);
  }

  ~StereoCameraTest() override {
    rig_.reset();
    EXPECT_EQ(kernel_.openDescriptors(), 0);
    EXPECT_EQ(kernel_.mappings(), 0);
  }

  StereoConfig config() {
    StereoConfig config;
    config.left = cameraConfig("left", kernel_.path(0));
    config.right = cameraConfig("right", kernel_.path(1));
    config.max_skew_s = 0.0019;
    return config;
  }

  static CameraConfig cameraConfig(const std::string& name, const std::string& device) {
    CameraConfig camera;
    camera.name = name;
    camera.device = device;
    camera.format = {PixelFormat::Any, 32, 16, 250.0};
    camera.encoding = Encoding::Mono8;
    camera.stall_timeout_s = 20.0;  // a busy computer is no stall
    return camera;
  }

  void start(const StereoConfig& config, milliseconds receiver_delay = {}) {
    rig_->start(config, receiver_delay);
  }
  bool morePairsCome() { return rig_->pairsCome(10); }
  bool rightIsRetrying() {
    return comesTrue([this] { return rig_->right().state == CameraState::Retrying; });
  }
  template <class Condition>
  bool comesTrue(Condition&& condition) {
    return StereoRig::comesTrue(condition);
  }

  FakeKernel kernel_;
  std::unique_ptr<StereoRig> rig_ = std::make_unique<StereoRig>(kernel_, kernel_.finder());
};

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
    EXPECT_EQ(images.pair.skew_ns(), 1'000'000);
    std::uint32_t drawn = 0;
    std::memcpy(&drawn, left.image.pixels.data(), sizeof(drawn));
    EXPECT_EQ(drawn, left.sequence) << "the picture is the one of the stamp";
  }
}

TEST_F(StereoCameraTest, TheLargestSkewCanBeChangedWhileItRuns) {
  kernel_.change(1, [](FakeCamera& camera) { camera.offset_ns = 1'000'000; });
  start(config());
  ASSERT_TRUE(morePairsCome());
  rig_->camera().setMaxSkew(0.0005);
  EXPECT_DOUBLE_EQ(rig_->camera().status().max_skew_s, 0.0005);
  const auto aloneSoFar = [this] { return rig_->camera().status().pairing.without_partner[0]; };
  const auto alone = aloneSoFar();
  EXPECT_TRUE(comesTrue([&] { return aloneSoFar() > alone + 10; }));
  rig_->camera().setMaxSkew(0.0015);
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

TEST_F(StereoCameraTest, ComesBackAfterEveryFaultWhileTheOtherCameraRuns) {
  auto impatient = config();
  impatient.right.stall_timeout_s = 1.0;
  start(impatient);
  ASSERT_TRUE(morePairsCome());
  const auto afterFault = [this](const std::string& said, const auto& fault) {
    kernel_.change(1, fault);
    EXPECT_TRUE(comesTrue([&] { return rig_->right().problem.find(said) != std::string::npos; })) << said;
    const auto left_frames = rig_->left().frames;
    EXPECT_TRUE(comesTrue([&] { return rig_->left().frames > left_frames + 10; }));
    kernel_.change(1, [](FakeCamera& camera) {
      camera.open_error = camera.stream_on_error = camera.dequeue_error = camera.format_error = 0;
      camera.stalled = false;
    });
    EXPECT_TRUE(morePairsCome());
  };
  const auto withEio = [](int FakeCamera::*error, int value) {
    return [error, value](FakeCamera& camera) {
      camera.dequeue_error = EIO;
      camera.*error = value;
    };
  };
  afterFault("USB transfer failed", withEio(&FakeCamera::dequeue_error, EIO));
  afterFault("no image for 1.0", [](FakeCamera& camera) { camera.stalled = true; });
  afterFault("USB bus has no bandwidth", withEio(&FakeCamera::stream_on_error, ENOSPC));
  afterFault("usermod -aG video", withEio(&FakeCamera::open_error, EACCES));
  afterFault("another program uses", withEio(&FakeCamera::format_error, EBUSY));
  const auto status = rig_->camera().status();
  EXPECT_GE(status.right.reconnections, 5u);
  EXPECT_GE(status.right.stalls, 1u);
  EXPECT_EQ(status.left.reconnections, 0u);
  EXPECT_EQ(status.right.problem, "");
}

TEST_F(StereoCameraTest, FindsACameraAtItsPortUnderAnotherNumber) {
  start(config());
  ASSERT_TRUE(morePairsCome());
  const FakeCamera camera = kernel_.look(1);
  kernel_.unplug(1);
  ASSERT_TRUE(rightIsRetrying());
  // A stranger takes the old number; it must not be used.
  FakeCamera stranger;
  stranger.bus_info = "usb-fake-9";
  kernel_.plugIn(1, stranger);
  FakeCamera same;
  same.bus_info = camera.bus_info;
  kernel_.plugIn(5, same);
  EXPECT_TRUE(morePairsCome());
  EXPECT_EQ(rig_->right().device.path, kernel_.path(5));
  EXPECT_EQ(kernel_.look(1).frames_sent, 0u);
}

TEST_F(StereoCameraTest, StartsWithoutCamerasAndPairsOnceTheyAreThere) {
  const FakeCamera left = kernel_.look(0);
  kernel_.unplug(0);
  start(config());
  ASSERT_TRUE(comesTrue([this] { return rig_->left().failed_attempts >= 2; }));
  kernel_.plugIn(0, left);
  EXPECT_TRUE(morePairsCome());
  EXPECT_EQ(rig_->left().reconnections, 0u) << "the first time is no reconnection";
}

TEST_F(StereoCameraTest, FiftyCyclesLeaveNothingBehind) {
  start(config());
  for (std::uint64_t cycle = 0; cycle < 50; ++cycle) {
    ASSERT_TRUE(comesTrue([&] {
      return rig_->right().reconnections == cycle && rig_->right().state == CameraState::Streaming;
    }));
    EXPECT_LE(kernel_.openDescriptors(), 4);
    EXPECT_EQ(kernel_.mappings(), 8);
    kernel_.change(1, [](FakeCamera& camera) { camera.dequeue_error = EIO; });
    ASSERT_TRUE(rightIsRetrying());
    kernel_.change(1, [](FakeCamera& camera) { camera.dequeue_error = 0; });
  }
}

TEST_F(StereoCameraTest, CorruptImagesAreCountedAndTheStreamGoesOn) {
  kernel_.change(1, [](FakeCamera& camera) {
    camera.fourcc = V4L2_PIX_FMT_MJPEG;
    camera.payload = {0xff, 0xd8, 0xff, 0xe0, 1, 2, 3};
  });
  start(config());
  ASSERT_TRUE(comesTrue([this] { return rig_->right().undecodable > 20; }));
  EXPECT_EQ(rig_->right().frames, 0u);
  EXPECT_GT(rig_->left().frames, 0u);
  EXPECT_NE(rig_->log().find("broken JPEG"), std::string::npos);
}

TEST_F(StereoCameraTest, ASlowReceiverGetsTheNewestPairsAndLossIsCounted) {
  start(config(), milliseconds(30));
  ASSERT_TRUE(rig_->pairsCome(20));
  const auto pairs = rig_->stop();
  const auto status = rig_->camera().status();
  EXPECT_GT(status.delivered_late, 0u);
  EXPECT_EQ(status.left.stalls + status.right.stalls, 0u);
  EXPECT_GE(status.pairing.pairs, pairs.size() + status.delivered_late);
}

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
  EXPECT_TRUE(comesTrue([this] { return kernel_.look(1).controls[0].value == 55; }));
  kernel_.change(1, [](FakeCamera& camera) {
    camera.dequeue_error = EIO;
    camera.controls[0].value = 0;
  });
  ASSERT_TRUE(rightIsRetrying());
  kernel_.change(1, [](FakeCamera& camera) { camera.dequeue_error = 0; });
  ASSERT_TRUE(morePairsCome());
  EXPECT_EQ(kernel_.look(1).controls[0].value, 55);
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

TEST_F(StereoCameraTest, AnAutomaticExposureThatTheCameraDoesNotTellIsNotBelieved) {
  kernel_.change(0, [](FakeCamera& camera) {
    camera.controls = {{V4L2_CID_EXPOSURE_AUTO, "Auto Exposure", 0, 3, 3},
                       {V4L2_CID_EXPOSURE_ABSOLUTE, "Exposure Time, Absolute", 1, 100, 20}};
  });
  start(config());
  ASSERT_TRUE(morePairsCome());
  const auto pairs = rig_->stop();
  EXPECT_TRUE(std::isnan(pairs.back().pair.left.exposure_s));
}

TEST_F(StereoCameraTest, MatchExposureLetsTheRightCameraFollow) {
  const auto withControls = [](std::int32_t exposure) {
    return [exposure](FakeCamera& camera) {
      camera.controls = {{V4L2_CID_GAIN, "Gain", 0, 100, exposure / 2},
                         {V4L2_CID_EXPOSURE_AUTO, "Auto Exposure", 0, 3, 3},
                         {V4L2_CID_EXPOSURE_ABSOLUTE, "Exposure Time, Absolute", 1, 100, exposure}};
    };
  };
  kernel_.change(0, withControls(30));
  kernel_.change(1, withControls(5));
  auto matched = config();
  matched.match_exposure = true;
  start(matched);
  const auto rightHas = [this](std::int32_t gain, std::int32_t exposure) {
    const auto controls = kernel_.look(1).controls;
    return controls[0].value == gain && controls[1].value == V4L2_EXPOSURE_MANUAL &&
           controls[2].value == exposure;
  };
  EXPECT_TRUE(comesTrue([&] { return rightHas(15, 30); }));
  kernel_.change(0, withControls(44));
  EXPECT_TRUE(comesTrue([&] { return rightHas(22, 44); }));
}

}  // namespace
}  // namespace stereo_nav::capture
