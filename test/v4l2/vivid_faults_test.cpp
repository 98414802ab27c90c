// Runs inside the virtual machine of vm.sh: vivid's faults, and that they leave nothing behind.
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/prctl.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "v4l2/vivid_fixture.h"

namespace stereo_nav::camera {
namespace {

std::size_t openDescriptors() {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

/// Memory that the program asked for, without its code, since the system keeps a varying part of that. Freed
/// memory is given back to the system first.
long residentKilobytes() {
  malloc_trim(0);
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    long value = 0;
    if (word == "RssAnon:" && status >> value) return value;
  }
  return 0;
}

void writeTo(const std::string& path, const std::string& text) {
  std::ofstream(path) << text << std::flush;
}

TEST_F(Vivid, ComesBackAfterFatalErrorDisconnectAndRefusedStart) {
  rig_.start(configOf(320, 180));
  ASSERT_TRUE(rig_.pairsCome(5));
  auto since = Clock::now();
  press(kRight, "inject_fatal_streaming_error");
  ASSERT_TRUE(test::waitUntil([this] { return rig_.right().state == CameraState::kRetrying; }));
  expectPairsAgain(since, "fatal_error");

  since = Clock::now();
  press(kRight, "disconnect");
  ASSERT_TRUE(test::waitUntil([this] { return rig_.right().state == CameraState::kRetrying; }));
  EXPECT_NE(rig_.right().problem.find("unplugged"), std::string::npos) << rig_.right().problem;
  expectPairsAgain(since, "disconnect");

  press(kRight, "inject_vidioc_streamon_error");  // hits the next start, which is this one's
  since = Clock::now();
  press(kRight, "inject_fatal_streaming_error");
  ASSERT_TRUE(test::waitUntil([this] { return rig_.right().failed_attempts >= 1; }));
  expectPairsAgain(since, "refused_start");
  EXPECT_EQ(rig_.right().reconnections, 3u);
  EXPECT_EQ(rig_.left().reconnections, 0u) << "the other camera was not disturbed";
}

TEST_F(Vivid, ComesBackWhenBothCamerasWereRemovedAndBoundAgain) {
  rig_.start(configOf(320, 180));
  ASSERT_TRUE(rig_.pairsCome(5));
  writeTo(kDriver + "unbind", "vivid.0");
  ASSERT_TRUE(test::waitUntil([this] {
    return rig_.left().state == CameraState::kRetrying && rig_.right().state == CameraState::kRetrying;
  }));
  ASSERT_TRUE(test::waitUntil(
      [this] { return rig_.left().failed_attempts >= 2 && rig_.right().failed_attempts >= 2; }));
  writeTo(kDriver + "bind", "vivid.0");
  expectPairsAgain(Clock::now(), "removed_and_bound");
  EXPECT_EQ(rig_.left().reconnections, 1u);
  EXPECT_EQ(rig_.right().reconnections, 1u);
}

TEST_F(Vivid, FiftyReconnectionsLeaveNothingBehind) {
  // Otherwise the kernel may hand out 2 MB where the program asks for 60 kB.
  ::prctl(PR_SET_THP_DISABLE, 1, 0, 0, 0);
  rig_.keepImages(false);
  rig_.start(configOf(320, 180));
  ASSERT_TRUE(rig_.pairsCome(3));
  const auto cycle = [this](std::uint64_t number) {
    press(kRight, number % 2 == 0 ? "inject_fatal_streaming_error" : "disconnect");
    return test::waitUntil([&] { return rig_.right().reconnections == number + 1; });
  };
  std::uint64_t number = 0;
  // Measured always after the same number of pairs: a driver's buffers take memory when they are first used.
  const auto settle = [this] { return rig_.pairsCome(12); };
  for (; number < 10; ++number) ASSERT_TRUE(cycle(number));
  ASSERT_TRUE(settle());
  const auto descriptors = openDescriptors();
  const long memory_kb = residentKilobytes();
  for (; number < 50; ++number) ASSERT_TRUE(cycle(number));
  ASSERT_TRUE(settle());
  EXPECT_EQ(openDescriptors(), descriptors);
  const long growth_kb = residentKilobytes() - memory_kb;
  std::cout << "memory grew by " << growth_kb << " kB over 40 reconnections, " << descriptors
            << " descriptors\n";
  RecordProperty("memory_growth_kb", std::to_string(growth_kb));
  EXPECT_LT(growth_kb, 1024) << "the record of stamps grows by some 100 bytes a frame";
}

}  // namespace
}  // namespace stereo_nav::camera
