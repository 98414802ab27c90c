// The faults that a camera can have, and its recovery from each.
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cerrno>
#include <filesystem>

#include "unit/sensors/camera/stereo_camera_fixture.h"

namespace stereo_nav::camera {
namespace {

TEST_F(StereoCameraTest, ComesBackAfterEveryFaultWhileTheOtherCameraRuns) {
  auto impatient = config();
  impatient.right.stall_timeout_s = 1.0;
  start(impatient);
  ASSERT_TRUE(morePairsCome());
  const auto afterFault = [this](const std::string& said, const auto& fault) {
    kernel_.change(1, fault);
    EXPECT_TRUE(test::waitUntil([&] { return rig_->right().problem.find(said) != std::string::npos; }))
        << said;
    const auto left_frames = rig_->left().frames;
    EXPECT_TRUE(test::waitUntil([&] { return rig_->left().frames > left_frames + 10; }));
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
  ASSERT_TRUE(test::waitUntil([this] { return rig_->left().failed_attempts >= 2; }));
  kernel_.plugIn(0, left);
  EXPECT_TRUE(morePairsCome());
  EXPECT_EQ(rig_->left().reconnections, 0u) << "the first time is no reconnection";
}

TEST_F(StereoCameraTest, FiftyCyclesLeaveNothingBehind) {
  start(config());
  for (std::uint64_t cycle = 0; cycle < 50; ++cycle) {
    ASSERT_TRUE(test::waitUntil([&] {
      return rig_->right().reconnections == cycle && rig_->right().state == CameraState::kStreaming;
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
  ASSERT_TRUE(test::waitUntil([this] { return rig_->right().undecodable > 20; }));
  EXPECT_EQ(rig_->right().frames, 0u);
  EXPECT_GT(rig_->left().frames, 0u);
  EXPECT_NE(rig_->log().find("broken JPEG"), std::string::npos);
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

}  // namespace
}  // namespace stereo_nav::camera
