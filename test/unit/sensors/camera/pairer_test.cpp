#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

#include "sensors/camera/left_right_pairer.h"

namespace stereo_nav::camera {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kPeriod = 33 * kMillisecond;
constexpr std::int64_t kMaxTimeOffset = 16 * kMillisecond;

Frame frameAt(std::int64_t time_ns, std::uint32_t sequence) {
  Frame frame;
  frame.time_ns = time_ns;
  frame.sequence = sequence;
  return frame;
}

/// A frame that is exposed at `time_ns` and handed to the pairer at `arrival_ns`.
struct Event {
  std::int64_t arrival_ns;
  Side side;
  std::int64_t time_ns;
  std::uint32_t sequence;
};

struct Stream {
  std::int64_t period = kPeriod;
  std::int64_t offset = 0;
  std::int64_t jitter = 0;  ///< of the exposure, +-
  std::int64_t delay = 5 * kMillisecond;
  std::int64_t delay_jitter = 0;
  double loss = 0.0;                   ///< share of frames lost
  int stall_from = -1, stall_to = -1;  ///< frames not sent
  int burst = 1;                       ///< so many frames arrive together, with the last of them
};

void addStream(std::vector<Event>& events, Side side, const Stream& stream, int frames,
               std::mt19937& random) {
  const auto between = [&random](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  std::int64_t latest_arrival = 0;
  for (int i = 0; i < frames; ++i) {
    const std::int64_t time =
        1000 * kMillisecond + i * stream.period + stream.offset + between(-stream.jitter, stream.jitter);
    const int last_of_burst = (i / stream.burst + 1) * stream.burst - 1;
    const std::int64_t arrival =
        time + (last_of_burst - i) * stream.period + stream.delay + between(0, stream.delay_jitter);
    latest_arrival = std::max(latest_arrival + 1, arrival);
    if (i >= stream.stall_from && i < stream.stall_to) continue;
    if (std::bernoulli_distribution(stream.loss)(random)) continue;
    events.push_back({latest_arrival, side, time, static_cast<std::uint32_t>(i)});
  }
}

struct Result {
  std::vector<FramePair> pairs;
  std::vector<std::int64_t> latencies_ns;  ///< from the arrival of the later image to the pair
  PairerCounts counts;
  std::size_t waiting = 0;
  std::size_t most_waiting = 0;
};

Result run(const Stream& left, const Stream& right, int frames, std::int64_t max_time_offset = kMaxTimeOffset,
           unsigned seed = 1) {
  std::mt19937 random(seed);
  std::vector<Event> events;
  addStream(events, Side::kLeft, left, frames, random);
  addStream(events, Side::kRight, right, frames, random);
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.arrival_ns < b.arrival_ns; });
  LeftRightPairer pairer(kPeriod, max_time_offset);
  Result result;
  for (const auto& event : events) {
    auto pair = pairer.push(event.side, frameAt(event.time_ns, event.sequence));
    result.most_waiting =
        std::max({result.most_waiting, pairer.waiting(Side::kLeft), pairer.waiting(Side::kRight)});
    if (!pair) continue;
    std::int64_t later_arrival_ns = 0;
    for (const auto& arrived : events) {
      const auto sequence = arrived.side == Side::kLeft ? pair->left.sequence : pair->right.sequence;
      if (arrived.sequence == sequence) later_arrival_ns = std::max(later_arrival_ns, arrived.arrival_ns);
    }
    result.latencies_ns.push_back(event.arrival_ns - later_arrival_ns);
    result.pairs.push_back(std::move(*pair));
  }
  result.counts = pairer.counts();
  result.waiting = pairer.waiting(Side::kLeft) + pairer.waiting(Side::kRight);
  // Nothing is lost silently.
  const auto& counts = result.counts;
  EXPECT_EQ(events.size(), 2 * counts.pairs + counts.without_partner[0] + counts.without_partner[1] +
                               counts.out_of_order[0] + counts.out_of_order[1] + result.waiting);
  return result;
}

/// What must hold for every stream, whatever happens: order, each frame once, max_time_offset, bounded
/// memory.
void expectSound(const Result& result, std::int64_t max_time_offset = kMaxTimeOffset) {
  for (std::size_t i = 0; i < result.pairs.size(); ++i) {
    EXPECT_LE(std::abs(result.pairs[i].timeOffset_ns()), max_time_offset);
    if (i == 0) continue;
    EXPECT_GT(result.pairs[i].left.time_ns, result.pairs[i - 1].left.time_ns);
    EXPECT_GT(result.pairs[i].right.time_ns, result.pairs[i - 1].right.time_ns);
  }
  EXPECT_LE(result.most_waiting, 4u);
}

TEST(LeftRightPairer, PairsEveryFrameOfSteadyCameras) {
  for (std::int64_t offset = -16; offset <= 16; ++offset) {
    Stream right;
    right.offset = offset * kMillisecond;
    const auto result = run({}, right, 200);
    expectSound(result);
    EXPECT_EQ(result.pairs.size(), 200u) << offset;
    for (const auto& pair : result.pairs) EXPECT_EQ(pair.left.sequence, pair.right.sequence);
  }
}

TEST(LeftRightPairer, LetsAPairOutWhenItsLaterImageArrives) {
  LeftRightPairer pairer(kPeriod, kMaxTimeOffset);
  EXPECT_FALSE(pairer.push(Side::kLeft, frameAt(1000 * kMillisecond, 0)));
  const auto pair = pairer.push(Side::kRight, frameAt(1010 * kMillisecond, 0));
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->timeOffset_ns(), 10 * kMillisecond);
}

TEST(LeftRightPairer, WaitsForANearerFrameWhereOneCanCome) {
  LeftRightPairer pairer(kPeriod, 30 * kMillisecond);
  pairer.push(Side::kLeft, frameAt(1000 * kMillisecond, 0));
  EXPECT_FALSE(pairer.push(Side::kRight, frameAt(1025 * kMillisecond, 0))) << "left's next comes at 1033";
  const auto pair = pairer.push(Side::kLeft, frameAt(1033 * kMillisecond, 1));
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->left.sequence, 1u);
  EXPECT_EQ(pair->timeOffset_ns(), -8 * kMillisecond);
  EXPECT_EQ(pairer.counts().without_partner[0], 1u);
}

TEST(LeftRightPairer, DoesNotWaitForAFrameThatIsOverdue) {
  LeftRightPairer pairer(kPeriod, 30 * kMillisecond);
  pairer.push(Side::kLeft, frameAt(1000 * kMillisecond, 0));
  EXPECT_FALSE(pairer.push(Side::kRight, frameAt(1025 * kMillisecond, 0)));
  const auto pair = pairer.push(Side::kRight, frameAt(1058 * kMillisecond, 1));
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->timeOffset_ns(), 25 * kMillisecond);
}

TEST(LeftRightPairer, MeasuresThePeriodThroughLostFrames) {
  LeftRightPairer pairer(10 * kMillisecond, kMaxTimeOffset);
  for (const std::uint32_t sequence : {0u, 2u, 4u, 5u, 8u, 10u}) {
    pairer.push(Side::kLeft, frameAt(1000 * kMillisecond + sequence * kPeriod, sequence));
  }
  EXPECT_EQ(pairer.period_ns(), kPeriod);
}

TEST(LeftRightPairer, MeasuresThePeriodOfADriverThatDoesNotCount) {
  LeftRightPairer pairer(10 * kMillisecond, kMaxTimeOffset);
  for (int i = 0; i < 5; ++i) pairer.push(Side::kLeft, frameAt(1000 * kMillisecond + i * kPeriod, 0));
  EXPECT_EQ(pairer.period_ns(), kPeriod);
}

TEST(LeftRightPairer, ExactlyTheLargestTimeOffsetIsAllowedAndNotMore) {
  for (const std::int64_t beyond : {0, 1}) {
    LeftRightPairer pairer(kPeriod, kMaxTimeOffset);
    pairer.push(Side::kRight, frameAt(1000 * kMillisecond, 0));
    EXPECT_EQ(pairer.push(Side::kLeft, frameAt(1000 * kMillisecond + kMaxTimeOffset + beyond, 0)).has_value(),
              beyond == 0);
  }
}

TEST(LeftRightPairer, AFrameThatIsNotLaterIsDroppedAndCounted) {
  LeftRightPairer pairer(kPeriod, kMaxTimeOffset);
  pairer.push(Side::kLeft, frameAt(1000 * kMillisecond, 0));
  pairer.push(Side::kLeft, frameAt(1000 * kMillisecond, 1));
  pairer.push(Side::kLeft, frameAt(900 * kMillisecond, 2));
  EXPECT_EQ(pairer.counts().out_of_order[0], 2u);
  EXPECT_EQ(pairer.waiting(Side::kLeft), 1u);
}

TEST(LeftRightPairer, RestartForgetsOneCameraOnly) {
  LeftRightPairer pairer(kPeriod, kMaxTimeOffset);
  pairer.push(Side::kLeft, frameAt(1000 * kMillisecond, 0));
  pairer.restart(Side::kLeft);
  EXPECT_EQ(pairer.counts().without_partner[0], 1u);
  pairer.push(Side::kLeft, frameAt(500 * kMillisecond, 0));  // its clock may have started anew
  EXPECT_EQ(pairer.counts().out_of_order[0], 0u);
}

TEST(LeftRightPairer, StallOfOneCameraKeepsNoMoreThanAFewFrames) {
  Stream right;
  right.stall_from = 50;
  right.stall_to = 150;
  const auto result = run({}, right, 200);
  expectSound(result);
  EXPECT_EQ(result.pairs.size(), 100u);
  EXPECT_EQ(result.pairs[50].left.sequence, 150u) << "the first pair after the stall";
}

TEST(LeftRightPairer, DriftingCamerasLoseOneFrameEachTimeTheySlideByAFrame) {
  Stream right;
  right.period = kPeriod + kPeriod / 100;
  const auto result = run({}, right, 1000, kPeriod / 2 + kMillisecond);
  expectSound(result, kPeriod / 2 + kMillisecond);
  // Left sends 1000 frames while right sends 990: ten have no partner.
  EXPECT_NEAR(static_cast<double>(result.pairs.size()), 990.0, 2.0);
  EXPECT_NEAR(static_cast<double>(result.counts.without_partner[0]), 10.0, 2.0);
}

/// For a period T and skews below T/2 the nearest frame is unique: brute force finds it.
TEST(PairerProperty, EveryPairIsTheNearest) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    std::mt19937 random(seed);
    const auto between = [&random](std::int64_t low, std::int64_t high) {
      return std::uniform_int_distribution<std::int64_t>(low, high)(random);
    };
    Stream left, right;
    left.jitter = right.jitter = 1 * kMillisecond;
    right.offset = between(-13, 13) * kMillisecond;
    left.loss = right.loss = 0.1;
    left.delay_jitter = right.delay_jitter = 10 * kMillisecond;
    const auto result = run(left, right, 300, kMaxTimeOffset, seed);
    expectSound(result);
    std::size_t matching = 0;
    for (const auto& pair : result.pairs) matching += pair.left.sequence == pair.right.sequence ? 1 : 0;
    EXPECT_EQ(matching, result.pairs.size()) << "seed " << seed;
    EXPECT_GT(result.pairs.size(), 200u) << "about 0.9 * 0.9 * 300 have both images";
    for (const auto latency : result.latencies_ns) EXPECT_EQ(latency, 0) << "seed " << seed;
  }
}

TEST(PairerProperty, SoundUnderJitterDriftGapsBurstsAndStalls) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const auto between = [&random](std::int64_t low, std::int64_t high) {
      return std::uniform_int_distribution<std::int64_t>(low, high)(random);
    };
    const auto anyStream = [&between] {
      Stream stream;
      stream.period = kPeriod + between(-kPeriod / 20, kPeriod / 20);
      stream.offset = between(-kPeriod, kPeriod);
      stream.jitter = between(0, 15) * kMillisecond;
      stream.delay = between(0, 50) * kMillisecond;
      stream.delay_jitter = between(0, 60) * kMillisecond;
      stream.loss = 0.01 * static_cast<double>(between(0, 40));
      stream.stall_from = static_cast<int>(between(0, 250));
      stream.stall_to = stream.stall_from + static_cast<int>(between(0, 60));
      stream.burst = static_cast<int>(between(1, 5));
      return stream;
    };
    const Stream left = anyStream();
    const Stream right = anyStream();
    const std::int64_t max_time_offset = between(1, 40) * kMillisecond;
    SCOPED_TRACE(seed);
    expectSound(run(left, right, 300, max_time_offset, seed), max_time_offset);
  }
}

}  // namespace
}  // namespace stereo_nav::camera
