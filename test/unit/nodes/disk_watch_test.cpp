#include "nodes/recorder/disk_watch.h"

#include <gtest/gtest.h>

namespace stereo_nav::nodes {
namespace {

constexpr std::uint64_t kGiga = 1'000'000'000, kMega = 1'000'000;

TEST(DiskWatch, RateAndTimeLeftFollowFromTheLastTenSeconds) {
  DiskWatch disk(kGiga, 600.0);
  EXPECT_EQ(disk.state(), DiskWatch::State::kStarting);
  for (std::uint64_t t = 0; t < 30; ++t) disk.add(static_cast<double>(t), 1000 * kMega * t, 100 * kGiga);
  for (std::uint64_t t = 30; t <= 45; ++t)
    disk.add(static_cast<double>(t), 29000 * kMega + 20 * kMega * (t - 29), 21 * kGiga);
  EXPECT_NEAR(disk.rate(), 20e6, 1.0);
  EXPECT_NEAR(disk.secondsLeft().value(), 20e9 / 20e6, 1e-3);  // 20 of the 21 GB may be used
  EXPECT_EQ(disk.state(), DiskWatch::State::kGood);
  EXPECT_EQ(disk.text(), "recording 20.0 MB/s, 29.32 GB written, the disk lasts 17 min (21.0 GB free)");
}

TEST(DiskWatch, WarnsBeforeTheDiskIsFullAndSaysWhenItIs) {
  DiskWatch disk(kGiga, 600.0);
  disk.add(0.0, 0, 3 * kGiga);
  disk.add(1.0, 10 * kMega, 3 * kGiga);  // 200 s
  EXPECT_EQ(disk.state(), DiskWatch::State::kLow);
  EXPECT_NE(disk.text().find("full in 3.3 min at 10.0 MB/s (3.0 GB free)"), std::string::npos) << disk.text();
  disk.add(2.0, 20 * kMega, kGiga / 2);
  EXPECT_EQ(disk.state(), DiskWatch::State::kFull);
  EXPECT_EQ(disk.secondsLeft().value(), 0.0);
}

TEST(DiskWatch, TheRateOfTheFirstSecondsIsNotYetSaid) {
  DiskWatch disk(kGiga, 600.0);
  disk.add(0.0, 0, 50 * kGiga);
  disk.add(1.0, 5000, 50 * kGiga);  // by this it would last for months
  EXPECT_EQ(disk.state(), DiskWatch::State::kStarting);
  disk.add(5.0, 20 * kMega, 50 * kGiga);
  EXPECT_EQ(disk.state(), DiskWatch::State::kGood);
}

TEST(DiskWatch, ARecordingThatDoesNotGrowIsSaid) {
  DiskWatch disk(kGiga, 600.0);
  for (int t = 0; t <= 4; ++t) disk.add(t, 5000, 100 * kGiga);
  EXPECT_EQ(disk.state(), DiskWatch::State::kStarting);
  disk.add(6.0, 5000, 100 * kGiga);
  EXPECT_EQ(disk.state(), DiskWatch::State::kSilent);
  EXPECT_FALSE(disk.secondsLeft());
}

}  // namespace
}  // namespace stereo_nav::nodes
