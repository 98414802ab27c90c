#include "stereo_nav/capture/stereo_camera.h"

#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
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
  waiting.max_skew_s = 0.003;
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
  faster.max_skew_s = 0.0051;
  start(faster);
  ASSERT_TRUE(rig_->pairsCome(250));  // the skew passes a whole period twice
  EXPECT_NEAR(rig_->camera().status().skew_rate, 0.01, 0.001);
  EXPECT_NE(rig_->log().find("runs at 100 Hz instead of 160"), std::string::npos) << rig_->log();
}

TEST_F(StereoCameraTest, StampsOfAnUnknownClockAreUsedWithAWarning) {
  kernel_.change(0, [](FakeCamera& camera) { camera.stamp_flags = V4L2_BUF_FLAG_TIMESTAMP_COPY; });
  start(config());
  ASSERT_TRUE(morePairsCome());
  EXPECT_NE(rig_->log().find("does not say of which clock"), std::string::npos) << rig_->log();
  EXPECT_NE(rig_->left().clock_warning, "");
  EXPECT_EQ(rig_->right().clock_warning, "");
  for (const auto& images : rig_->stop()) EXPECT_EQ(images.pair.skew_ns(), 0) << "by the stamps";
}

TEST_F(StereoCameraTest, ANameByIdIsTheCameraItselfAtAnyPort) {
  const std::filesystem::path links = std::filesystem::path(kernel_.path(1)).parent_path() / "v4l/by-id";
  std::filesystem::create_directories(links);
  std::filesystem::create_symlink("../../video1", links / "usb-maker-serial");
  auto by_id = config();
  by_id.right.device = links / "usb-maker-serial";
  start(by_id);
  ASSERT_TRUE(morePairsCome());
  kernel_.unplug(1);
  ASSERT_TRUE(rightIsRetrying());
  std::filesystem::remove(links / "usb-maker-serial");
  FakeCamera elsewhere;
  elsewhere.bus_info = "usb-fake-7";
  kernel_.plugIn(5, elsewhere);
  std::filesystem::create_symlink("../../video5", links / "usb-maker-serial");
  EXPECT_TRUE(morePairsCome());
  EXPECT_EQ(rig_->right().device.bus_info, "usb-fake-7");
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
  rig_->camera().right().setControl("auto_exposure", 0);  // the new name of what was set by its old one
  EXPECT_TRUE(comesTrue([this] { return kernel_.look(1).controls[0].value == 55; }));
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
  EXPECT_TRUE(rig_->left().exposure_untold);
  // One that changes while nobody sets it is alive, whatever the driver's flags say.
  kernel_.change(0, [](FakeCamera& camera) { camera.controls[1].value = 24; });
  EXPECT_TRUE(comesTrue([this] { return !rig_->left().exposure_untold; }));
  ASSERT_TRUE(morePairsCome());
  const auto pairs = rig_->stop();
  EXPECT_TRUE(std::isnan(pairs.front().pair.left.exposure_s));
  EXPECT_DOUBLE_EQ(pairs.back().pair.left.exposure_s, 0.0024);
}

/// The right camera follows the left one's exposure and gain.
class MatchExposureTest : public StereoCameraTest {
 protected:
  /// Of the left camera; the right one's are automatic at first.
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
    return comesTrue([this, gain, exposure] {
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
  EXPECT_TRUE(comesTrue([this] { return rig_->log().find("set exposure_ms") != std::string::npos; }));
  EXPECT_EQ(kernel_.look(1).controls[1].value, V4L2_EXPOSURE_APERTURE_PRIORITY);
  setLeft(44);
  EXPECT_TRUE(rightGets(22, 44));
}

}  // namespace
}  // namespace stereo_nav::capture
