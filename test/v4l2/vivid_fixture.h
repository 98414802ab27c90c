#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "sensors/camera/v4l2_device.h"
#include "unit/sensors/camera/stereo_rig.h"
#include "v4l2/recording_kernel.h"

namespace stereo_nav::camera {

using Clock = std::chrono::steady_clock;

inline const std::string kLeft = "/dev/video0";
inline const std::string kRight = "/dev/video1";
inline const std::string kDriver = "/sys/bus/platform/drivers/vivid/";

inline StereoConfig configOf(int width, int height) {
  StereoConfig config;
  config.left.name = "left";
  config.left.device = kLeft;
  config.left.format = {PixelFormat::kYuyv, width, height, 15.0};
  config.left.encoding = Encoding::kMono8;
  config.left.stall_timeout_s = 5.0;  // the machine is emulated: a busy host stops it for a while
  config.right = config.left;
  config.right.name = "right";
  config.right.device = kRight;
  config.max_time_offset_s = 0.034;
  return config;
}

/// Sets a control from outside, as v4l2-ctl would.
inline std::int32_t setControl(const std::string& path, const std::string& name, std::int32_t value) {
  V4l2Device device(camera::linuxKernel(), path);
  const Control* control = device.controls().find(name);
  if (control == nullptr) throw std::runtime_error(path + " has no control " + name);
  return device.controls().set(*control, value);
}

inline std::int32_t getControl(const std::string& path, const std::string& name) {
  V4l2Device device(camera::linuxKernel(), path);
  return device.controls().get(*device.controls().find(name));
}

/// A button whose effect makes the device fail at once: reading it back is not possible.
inline void press(const std::string& path, const std::string& name) {
  try {
    setControl(path, name, 1);
  } catch (const CaptureError&) {
  }
}

/// The kernel's two virtual test cameras (driver vivid), captured with a record of what they delivered.
class Vivid : public testing::Test {
 protected:
  Vivid() {
    for (const auto& path : {kLeft, kRight}) {
      if (!std::filesystem::exists(path)) continue;
      setControl(path, "percentage_of_dropped_buffers", 0);
    }
  }

  /// Each published frame is one that the driver handed out, with its very stamp and number.
  void expectKernelStamps(const std::vector<StereoImages>& pairs) {
    const auto check = [this](const Frame& frame, const std::string& path, std::size_t& at) {
      const auto buffers = kernel_.buffersOf(path);
      while (at < buffers.size() && buffers[at].stamp_us * 1000 != frame.stamp_ns) ++at;
      ASSERT_LT(at, buffers.size()) << path << " never gave the stamp " << frame.stamp_ns;
      EXPECT_EQ(frame.sequence, buffers[at].sequence);
    };
    std::size_t left_at = 0, right_at = 0;
    for (const auto& images : pairs) {
      check(images.pair.left, kLeft, left_at);
      check(images.pair.right, kRight, right_at);
    }
  }

  /// Pairs that the cameras' frames could have made and did not: frames of both that are each other's
  /// nearest, well within the largest skew.
  std::size_t missedPairs(const std::vector<StereoImages>& pairs) {
    constexpr std::int64_t kWellWithin_us = 20'000;
    using Buffers = std::vector<RecordingKernel::Buffer>;
    const auto nearest = [](const Buffers& buffers, std::int64_t stamp_us) {
      return std::min_element(buffers.begin(), buffers.end(),
                              [stamp_us](const auto& a, const auto& b) {
                                return std::abs(a.stamp_us - stamp_us) < std::abs(b.stamp_us - stamp_us);
                              })
          ->stamp_us;
    };
    std::set<std::int64_t> paired_us;
    for (const auto& images : pairs) paired_us.insert(images.pair.left.stamp_ns / 1000);
    const Buffers lefts = kernel_.buffersOf(kLeft), rights = kernel_.buffersOf(kRight);
    const auto missed = [&](const RecordingKernel::Buffer& left) {
      if (left.stamp_us < *paired_us.begin() || left.stamp_us > *paired_us.rbegin()) return false;
      const std::int64_t right_us = nearest(rights, left.stamp_us);
      const bool neighbours =
          std::abs(right_us - left.stamp_us) <= kWellWithin_us && nearest(lefts, right_us) == left.stamp_us;
      return neighbours && paired_us.count(left.stamp_us) == 0;
    };
    return static_cast<std::size_t>(std::count_if(lefts.begin(), lefts.end(), missed));
  }

  /// Numbers that the driver left out. A vivid that a busy host kept from running gives one number twice.
  std::uint64_t gapsIn(const std::string& path) {
    const auto buffers = kernel_.buffersOf(path);
    std::uint64_t gaps = 0;
    for (std::size_t i = 1; i < buffers.size(); ++i) {
      const std::uint32_t step = buffers[i].sequence - buffers[i - 1].sequence;
      if (step > 1 && step < 0x80000000u) gaps += step - 1;
    }
    return gaps;
  }

  /// Seconds from `since` to the first pairs; reported, and limited only by the time for which the rig waits.
  void expectPairsAgain(Clock::time_point since, const std::string& fault) {
    EXPECT_TRUE(rig_.pairsCome(3)) << fault;
    const double seconds = std::chrono::duration<double>(Clock::now() - since).count();
    RecordProperty(fault + "_seconds_to_pairs", std::to_string(seconds));
    std::cout << fault << ": pairs again after " << seconds << " s\n";
  }

  RecordingKernel kernel_;
  StereoRig rig_{kernel_, DeviceFinder(kernel_)};
};

}  // namespace stereo_nav::camera
