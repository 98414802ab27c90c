// Runs inside the virtual machine of vm.sh, on the kernel's two virtual test cameras (driver vivid).
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <utility>

#include "v4l2/vivid_fixture.h"

namespace stereo_nav::camera {
namespace {

class VividSize : public Vivid, public testing::WithParamInterface<std::pair<int, int>> {};

TEST_P(VividSize, PairsAtTheDeliveredRateWithTheKernelsStamps) {
  rig_.start(configOf(GetParam().first, GetParam().second));
  ASSERT_TRUE(rig_.pairsCome(60));
  const auto pairs = rig_.stop();
  const auto status = rig_.camera().status();
  expectOrdered(pairs);
  expectKernelStamps(pairs);
  EXPECT_EQ(status.left.lost, gapsIn(kLeft));
  EXPECT_EQ(status.right.lost, gapsIn(kRight));
  EXPECT_DOUBLE_EQ(status.left.format.rate_hz, 15.0);
  EXPECT_EQ(status.left.clock_warning, "");
  // Every frame delivered is in a pair, has no partner (and is counted), or waits for one: at most four do.
  const auto& alone = status.pairing.without_partner;
  const auto waiting = [&](const CameraStatus& camera, std::uint64_t without_partner) {
    return camera.frames - status.pairing.pairs - without_partner;
  };
  EXPECT_LE(waiting(status.left, alone[0]), 4u);
  EXPECT_LE(waiting(status.right, alone[1]), 4u);
  const std::uint64_t overtaken = status.left.skipped + status.right.skipped;
  EXPECT_LE(missedPairs(pairs), overtaken) << "every pair is there but for images that came too late";
  std::cout << pairs.size() << " pairs of " << status.left.frames << " + " << status.right.frames
            << " frames, " << overtaken << " overtaken, " << alone[0] + alone[1] << " without partner, lost "
            << status.left.lost << " + " << status.right.lost << ", pair rate " << status.pair_rate_hz
            << " Hz\n";
}

INSTANTIATE_TEST_SUITE_P(Sizes, VividSize, testing::Values(std::pair(320, 180), std::pair(640, 360)));

TEST_F(Vivid, ControlsSetAreTheControlsReadBack) {
  auto config = configOf(320, 180);
  config.left.controls = {{"brightness", 111}, {"contrast", 77}, {"gain_automatic", 0}, {"gain", 42}};
  config.right.controls = {{"brightness", 99}, {"exposure_auto", 1}};
  rig_.start(config);
  ASSERT_TRUE(rig_.pairsCome(3));
  EXPECT_EQ(getControl(kLeft, "brightness"), 111);
  EXPECT_EQ(getControl(kLeft, "contrast"), 77);
  EXPECT_EQ(getControl(kLeft, "gain"), 42);
  EXPECT_EQ(getControl(kRight, "brightness"), 99);
  ASSERT_EQ(rig_.right().control_warnings.size(), 1u);
  EXPECT_NE(rig_.right().control_warnings[0].find("exposure_auto"), std::string::npos);
}

TEST_F(Vivid, DroppedBuffersAreCountedAsLost) {
  for (const auto& path : {kLeft, kRight}) setControl(path, "percentage_of_dropped_buffers", 30);
  rig_.start(configOf(320, 180));
  ASSERT_TRUE(rig_.pairsCome(40));
  const auto pairs = rig_.stop();
  const auto status = rig_.camera().status();
  expectOrdered(pairs);
  expectKernelStamps(pairs);
  EXPECT_EQ(status.left.lost, gapsIn(kLeft));
  EXPECT_EQ(status.right.lost, gapsIn(kRight));
  EXPECT_GT(status.left.lost + status.right.lost, 20u);
  EXPECT_EQ(status.left.reconnections + status.right.reconnections, 0u);
}

TEST_F(Vivid, FlaggedBuffersAreDroppedAndCounted) {
  rig_.start(configOf(320, 180));
  ASSERT_TRUE(rig_.pairsCome(5));
  for (int i = 0; i < 5; ++i) {
    press(kLeft, "inject_v4l2_buf_flag_error");
    ASSERT_TRUE(rig_.pairsCome(3));
  }
  rig_.stop();
  std::uint64_t flagged = 0;
  for (const auto& buffer : kernel_.buffersOf(kLeft))
    flagged += (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 ? 1 : 0;
  EXPECT_EQ(rig_.left().flagged_broken, flagged);
  EXPECT_EQ(flagged, 5u);
}

TEST_F(Vivid, MatchExposureLetsTheRightGainFollow) {
  auto config = configOf(320, 180);
  config.match_exposure = true;
  config.left.controls = {{"gain_automatic", 0}, {"gain", 33}};
  config.right.controls = {{"gain_automatic", 0}, {"gain", 0}};
  rig_.start(config);
  EXPECT_TRUE(test::waitUntil([] { return getControl(kRight, "gain") == 33; }));
}

TEST_F(Vivid, FinderSeesTheCamerasByTheirPorts) {
  const auto devices = DeviceFinder(camera::linuxKernel()).list();
  const auto found = std::find_if(devices.begin(), devices.end(), [](const FoundDevice& device) {
    return device.bus_info == "platform:vivid-001";
  });
  ASSERT_NE(found, devices.end());
  EXPECT_EQ(found->path, kRight);
  V4l2Device device(camera::linuxKernel(), found->path);
  EXPECT_FALSE(device.offeredFormats().empty());
}

}  // namespace
}  // namespace stereo_nav::camera
