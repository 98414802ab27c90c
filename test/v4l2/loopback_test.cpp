// Runs inside the virtual machine of vm.sh, on two v4l2loopback devices that this program feeds itself.
#include <gtest/gtest.h>

#include <chrono>
#include <iostream>
#include <memory>

#include "unit/sensors/camera/stereo_rig.h"
#include "v4l2/feeder.h"

namespace stereo_nav::camera {
namespace {

using namespace std::chrono_literals;

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr auto kPeriod = 100ms;  // the machine is emulated and slow
const std::string kLeft = "/dev/video10";
const std::string kRight = "/dev/video11";

std::vector<std::uint8_t> yuyvOf(const cv::Mat& grey) {
  std::vector<std::uint8_t> bytes(grey.total() * 2, 128);
  for (std::size_t i = 0; i < grey.total(); ++i) bytes[2 * i] = grey.data[i];
  return bytes;
}

class Loopback : public testing::Test {
 protected:
  void feed(std::uint32_t fourcc, std::chrono::nanoseconds right_offset,
            std::chrono::nanoseconds right_period) {
    const Feeder::Source source = [fourcc](std::uint32_t counter) {
      const cv::Mat image = drawCounter(kWidth, kHeight, counter);
      return fourcc == V4L2_PIX_FMT_MJPEG ? jpegOf(image) : yuyvOf(image);
    };
    left_ = std::make_unique<Feeder>(kLeft, fourcc, kWidth, kHeight);
    right_ = std::make_unique<Feeder>(kRight, fourcc, kWidth, kHeight);
    first_ = std::chrono::steady_clock::now() + 200ms;
    left_->start(first_, kPeriod, source);
    right_->start(first_ + right_offset, right_period, source);
  }

  void start(PixelFormat format) {
    StereoConfig config;
    config.left.name = "left";
    config.left.device = kLeft;
    config.left.format = {format, kWidth, kHeight, 10.0};
    config.left.encoding = Encoding::kMono8;
    config.left.stall_timeout_s = 8.0;  // a busy host stops the machine for a while
    config.right = config.left;
    config.right.name = "right";
    config.right.device = kRight;
    config.max_time_offset_s = 0.048;
    rig_ = std::make_unique<StereoRig>(camera::linuxKernel(), DeviceFinder(camera::linuxKernel()));
    rig_->start(config);
  }

  /// Both images of every pair show the same counter, and counters grow.
  void expectMatchingCounters(std::vector<StereoImages> pairs) {
    expectOrdered(pairs);
    // When a reader asks for buffers, v4l2loopback gives the images in them new stamps: its first frame is an
    // old one.
    pairs.erase(pairs.begin());
    std::uint32_t previous = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto left = readCounter(pairs[i].pair.left.image.view());
      const auto right = readCounter(pairs[i].pair.right.image.view());
      EXPECT_EQ(left, right) << "pair " << i << ", time offset " << pairs[i].pair.timeOffset_ns() / 1000
                             << " us";
      if (i > 0) {
        EXPECT_GT(left, previous);
      }
      previous = left;
    }
    std::cout << pairs.size() << " pairs, last time offset " << pairs.back().pair.timeOffset_ns() / 1000
              << " us\n";
  }

  /// When the left feeder sends one of its next images. A feeder that began at any other time could stay half
  /// a period away from the left one, where no right image is near enough to a left one.
  Feeder::Time nextLeftImage() const {
    const auto periods = (std::chrono::steady_clock::now() - first_) / kPeriod;
    return first_ + (periods + 2) * kPeriod;
  }

  std::unique_ptr<Feeder> left_, right_;
  Feeder::Time first_;
  std::unique_ptr<StereoRig> rig_;
};

TEST_F(Loopback, PairsMatchForEveryOffset) {
  for (const auto offset : {0ms, 4ms, 8ms, 12ms, 16ms}) {
    SCOPED_TRACE(offset.count());
    feed(V4L2_PIX_FMT_YUYV, offset, kPeriod);
    start(PixelFormat::kYuyv);
    ASSERT_TRUE(rig_->pairsCome(20));
    expectMatchingCounters(rig_->stop());
    rig_.reset();
    left_.reset();
    right_.reset();
  }
}

TEST_F(Loopback, PairsMatchWhileTheCamerasDrift) {
  feed(V4L2_PIX_FMT_YUYV, -16ms, kPeriod + 500us);
  start(PixelFormat::kYuyv);
  ASSERT_TRUE(rig_->pairsCome(60));
  const double offset_rate = rig_->camera().status().time_offset_rate;
  expectMatchingCounters(rig_->stop());
  std::cout << "rate of the time offset " << offset_rate << " s/s, fed 0.005\n";
  EXPECT_NEAR(offset_rate, 0.005, 0.002);
}

TEST_F(Loopback, PairsMatchAsMjpgAndTheUnknownClockIsSaid) {
  feed(V4L2_PIX_FMT_MJPEG, 8ms, kPeriod);
  start(PixelFormat::kAny);
  ASSERT_TRUE(rig_->pairsCome(20));
  const auto status = rig_->camera().status();
  expectMatchingCounters(rig_->stop());
  EXPECT_EQ(status.left.format.layout.format, PixelFormat::kMjpg);
  EXPECT_EQ(status.left.undecodable, 0u);
  EXPECT_NE(status.left.clock_warning, "");
}

TEST_F(Loopback, ACameraThatStopsSendingComesBackWithItsFrames) {
  feed(V4L2_PIX_FMT_YUYV, 0ms, kPeriod);
  start(PixelFormat::kYuyv);
  ASSERT_TRUE(rig_->pairsCome(5));
  right_->stop();
  ASSERT_TRUE(test::waitUntil([this] { return rig_->right().stalls >= 1; }));
  const auto left_frames = rig_->left().frames;
  right_.reset();
  right_ = std::make_unique<Feeder>(kRight, V4L2_PIX_FMT_YUYV, kWidth, kHeight);
  right_->start(nextLeftImage(), kPeriod,
                [](std::uint32_t counter) { return yuyvOf(drawCounter(kWidth, kHeight, counter)); });
  EXPECT_TRUE(rig_->pairsCome(3)) << rig_->right().frames << " right images, " << rig_->log();
  EXPECT_GT(rig_->left().frames, left_frames);
  EXPECT_EQ(rig_->left().stalls, 0u);
}

}  // namespace
}  // namespace stereo_nav::camera
