#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cmath>

#include "sensors/camera/clock_beat.h"
#include "sensors/camera/clock_mapping.h"
#include "sensors/camera/driver_clock.h"
#include "sensors/camera/sequence_counter.h"

namespace stereo_nav::camera {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

/// Two clocks that a test turns; every reading takes some time.
struct TestClocks {
  std::int64_t monotonic_ns = 1000 * kSecond_ns;
  std::int64_t ros_offset_ns = 1'600'000'000 * kSecond_ns;
  std::int64_t reading_ns = 50;

  ClockMapping mapping() {
    return {[this] { return monotonic_ns += reading_ns; },
            [this] { return (monotonic_ns += reading_ns) + ros_offset_ns; }};
  }
};

TEST(ClockMapping, CarriesAStampTheSameWheneverItIsAsked) {
  TestClocks clocks;
  auto mapping = clocks.mapping();
  const std::int64_t stamp = clocks.monotonic_ns - 40'000'000;
  const std::int64_t at_once = mapping.toRos(stamp);
  EXPECT_NEAR(static_cast<double>(at_once - clocks.ros_offset_ns - stamp), 0.0, 100.0);
  // A busy computer asks 200 ms later: "now" has moved on, the stamp has not.
  clocks.monotonic_ns += 200'000'000;
  mapping.measure();
  EXPECT_NEAR(static_cast<double>(mapping.toRos(stamp) - at_once), 0.0, 100.0);
}

TEST(ClockMapping, FollowsASlewedAndASteppedClock) {
  TestClocks clocks;
  auto mapping = clocks.mapping();
  for (int second = 0; second < 10; ++second) {
    clocks.monotonic_ns += kSecond_ns;
    clocks.ros_offset_ns += 500'000;  // NTP slews by at most 500 ppm
    EXPECT_NEAR(static_cast<double>(mapping.measure()), 500'000.0, 100.0);
  }
  clocks.ros_offset_ns -= 3 * kSecond_ns;
  EXPECT_NEAR(static_cast<double>(mapping.measure()), -3.0 * kSecond_ns, 100.0);
  EXPECT_NEAR(static_cast<double>(mapping.offset_ns() - clocks.ros_offset_ns), 0.0, 100.0);
}

TEST(ClockMapping, AnInterruptedReadingDoesNotCount) {
  std::int64_t monotonic = 0;
  int calls = 0;
  ClockMapping mapping(
      [&] {
        // The process is put to sleep for 5 ms after every reading of ROS time but one.
        monotonic += ++calls % 10 == 4 ? 50 : (calls % 2 == 0 ? 5'000'000 : 50);
        return monotonic;
      },
      [&] { return (monotonic += 50) + 7 * kSecond_ns; });
  EXPECT_NEAR(static_cast<double>(mapping.offset_ns()), 7.0 * kSecond_ns, 200.0);
}

class FixedKernel : public Kernel {
 public:
  int open(const std::string&) override { return -1; }
  void close(int) override {}
  int ioctl(int, unsigned long, void*) override { return -1; }
  void* map(int, std::size_t, std::int64_t) override { return nullptr; }
  void unmap(void*, std::size_t) override {}
  Ready wait(int, int) override { return Ready::kNo; }
  std::int64_t monotonicNow() override { return 500 * kSecond_ns; }
  std::int64_t realtimeNow() override { return 1'700'000'000 * kSecond_ns; }
};

LentBuffer bufferStamped(std::int64_t stamp_ns, std::uint32_t flags) {
  LentBuffer buffer;
  buffer.stamp_ns = stamp_ns;
  buffer.flags = flags;
  buffer.dequeued_ns = 500 * kSecond_ns;
  return buffer;
}

TEST(DriverClock, MonotonicIsTakenAsItIsWithoutAWord) {
  FixedKernel kernel;
  DriverClock clock(kernel);
  const auto buffer = bufferStamped(499 * kSecond_ns, V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC);
  EXPECT_EQ(clock.monotonicStamp(buffer), 499 * kSecond_ns);
  EXPECT_EQ(clock.warning(), "");
}

TEST(DriverClock, UnknownClocksAreRecognisedWithAWarning) {
  FixedKernel kernel;
  DriverClock clock(kernel);
  EXPECT_EQ(clock.monotonicStamp(bufferStamped(499 * kSecond_ns, 0)), 499 * kSecond_ns);
  EXPECT_EQ(clock.kind(), DriverClock::Kind::kMonotonic);
  EXPECT_NE(clock.warning(), "");

  clock.reset();
  EXPECT_EQ(clock.monotonicStamp(bufferStamped(1'699'999'999 * kSecond_ns, 0)), 499 * kSecond_ns);
  EXPECT_EQ(clock.kind(), DriverClock::Kind::kRealTime);

  clock.reset();
  EXPECT_EQ(clock.monotonicStamp(bufferStamped(0, 0)), 500 * kSecond_ns);
  EXPECT_EQ(clock.kind(), DriverClock::Kind::kUnusable);
  EXPECT_NE(clock.warning(), "");
}

TEST(MiddleOfExposure, IsAfterAStartStampAndBeforeAnEndStamp) {
  const std::int64_t stamp = 10 * kSecond_ns;
  EXPECT_EQ(middleOfExposure(stamp, V4L2_BUF_FLAG_TSTAMP_SRC_SOE, 0.02, 0.0), stamp + 10'000'000);
  EXPECT_EQ(middleOfExposure(stamp, V4L2_BUF_FLAG_TSTAMP_SRC_EOF, 0.02, 0.0), stamp - 10'000'000);
  EXPECT_EQ(middleOfExposure(stamp, V4L2_BUF_FLAG_TSTAMP_SRC_SOE, std::nullopt, 0.0), stamp);
  EXPECT_EQ(middleOfExposure(stamp, V4L2_BUF_FLAG_TSTAMP_SRC_SOE, 0.02, 0.03), stamp + 25'000'000);
  EXPECT_EQ(middleOfExposure(stamp, V4L2_BUF_FLAG_TSTAMP_SRC_EOF, std::nullopt, 0.03), stamp - 15'000'000);
}

TEST(SequenceCounter, CountsGapsAndNothingElse) {
  SequenceCounter counter;
  for (const std::uint32_t sequence : {5u, 6u, 9u, 10u, 10u, 3u, 4u}) counter.add(sequence);
  EXPECT_EQ(counter.lost(), 2u);
  counter.restart();
  counter.add(0xfffffffeu);
  counter.add(1u);  // over the wrap: 0xffffffff and 0 are missing
  EXPECT_EQ(counter.lost(), 4u);
}

TEST(ClockBeat, MeasuresTheSlideAlsoWhenThePairingMovesOnByAFrame) {
  constexpr std::int64_t kPeriod = 33'333'333;
  constexpr double kRate = 4e-4;
  ClockBeat beat;
  EXPECT_TRUE(std::isnan(beat.timeOffsetRate()));
  for (int i = 0; i < 2000; ++i) {
    const std::int64_t time = i * kPeriod;
    auto skew = std::llround(kRate * static_cast<double>(time)) + 12'000'000;
    while (skew > kPeriod / 2) skew -= kPeriod;
    beat.add(time, skew, kPeriod);
  }
  EXPECT_NEAR(beat.timeOffsetRate(), kRate, 1e-8);
}

}  // namespace
}  // namespace stereo_nav::camera
