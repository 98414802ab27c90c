#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

#include "unit/sensors/camera/fake_kernel.h"
#include "unit/sensors/camera/stereo_rig.h"

namespace stereo_nav::camera {

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
    config.max_time_offset_s = 0.0019;
    return config;
  }

  static CameraConfig cameraConfig(const std::string& name, const std::string& device) {
    CameraConfig camera;
    camera.name = name;
    camera.device = device;
    camera.format = {PixelFormat::kAny, 32, 16, 250.0};
    camera.encoding = Encoding::kMono8;
    camera.stall_timeout_s = 20.0;  // a busy computer is no stall
    return camera;
  }

  void start(const StereoConfig& config, std::chrono::milliseconds receiver_delay = {}) {
    rig_->start(config, receiver_delay);
  }
  bool morePairsCome() { return rig_->pairsCome(10); }
  bool rightIsRetrying() {
    return test::waitUntil([this] { return rig_->right().state == CameraState::kRetrying; });
  }

  FakeKernel kernel_;
  std::unique_ptr<StereoRig> rig_ = std::make_unique<StereoRig>(kernel_, kernel_.finder());
};

}  // namespace stereo_nav::camera
