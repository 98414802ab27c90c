#include "ros/inbox.h"

#include <gtest/gtest.h>

#include <thread>

namespace stereo_nav::ros_io {
namespace {

constexpr std::chrono::milliseconds kTick(1);

FrameMessages frameAt(double time_s, SteadyTime arrival = SteadyTime()) {
  FrameMessages frame;
  frame.left_stamp = frame.right_stamp = ros::Time(time_s);
  frame.arrival = arrival;
  return frame;
}

ImuSample imuAt(double time_s) {
  ImuSample sample;
  sample.time_s = time_s;
  return sample;
}

TEST(Inbox, AFrameWaitsForTheImuSampleAfterIt) {
  Inbox inbox(InboxParams{});
  inbox.push(frameAt(10.0));
  inbox.addImu(imuAt(9.9));
  EXPECT_FALSE(inbox.take(SteadyTime() + kTick));
  inbox.addImu(imuAt(10.005));
  inbox.addImu(imuAt(10.01));
  const auto work = inbox.take(SteadyTime() + kTick);
  ASSERT_TRUE(work);
  ASSERT_EQ(work->imu.size(), 2u)
      << "up to the first one after the frame; the rest belongs to the next frame";
  EXPECT_EQ(work->imu.back().time_s, 10.005);
  EXPECT_FALSE(work->imu_late);
  EXPECT_EQ(inbox.framesWithoutImu(), 0u);
}

TEST(Inbox, TheLaterExposureOfThePairCounts) {
  Inbox inbox(InboxParams{});
  FrameMessages frame = frameAt(10.0);
  frame.right_stamp = ros::Time(10.05);
  inbox.push(frame);
  inbox.addImu(imuAt(10.01));
  EXPECT_FALSE(inbox.take(SteadyTime() + kTick));
  inbox.addImu(imuAt(10.06));
  EXPECT_TRUE(inbox.take(SteadyTime() + kTick));
}

TEST(Inbox, WaitingEndsAndIsCounted) {
  InboxParams params;
  params.imu_wait_s = 0.05;
  Inbox inbox(params);
  inbox.push(frameAt(10.0));
  inbox.addImu(imuAt(9.99));
  EXPECT_FALSE(inbox.take(SteadyTime() + std::chrono::milliseconds(49)));
  const auto work = inbox.take(SteadyTime() + std::chrono::milliseconds(51));
  ASSERT_TRUE(work);
  EXPECT_TRUE(work->imu_late);
  EXPECT_EQ(work->imu.size(), 1u);
  EXPECT_EQ(inbox.framesWithoutImu(), 1u);
}

TEST(Inbox, NoFrameWaitsForAnImuOfAnotherClock) {
  Inbox inbox(InboxParams{});
  inbox.push(frameAt(1000.0));
  inbox.addImu(imuAt(0.01));
  const auto work = inbox.take(SteadyTime());
  ASSERT_TRUE(work);
  EXPECT_TRUE(work->imu_late);
  EXPECT_EQ(inbox.framesWithoutImu(), 1u);
}

TEST(Inbox, WithoutAnImuNothingWaits) {
  InboxParams params;
  params.wait_for_imu = false;
  Inbox inbox(params);
  inbox.push(frameAt(10.0));
  EXPECT_TRUE(inbox.take(SteadyTime()));
}

TEST(Inbox, TheOldestFrameGivesWayAndItsJumpIsNotForgotten) {
  InboxParams params;
  params.capacity = 2;
  params.wait_for_imu = false;
  Inbox inbox(params);
  FrameMessages first = frameAt(1.0);
  first.after_jump = true;
  inbox.push(first);
  inbox.push(frameAt(2.0));
  inbox.push(frameAt(3.0));
  EXPECT_EQ(inbox.framesDropped(), 1u);
  const auto work = inbox.take(SteadyTime());
  ASSERT_TRUE(work);
  EXPECT_EQ(work->frame.left_stamp, ros::Time(2.0));
  EXPECT_TRUE(work->frame.after_jump);
}

TEST(Inbox, LateImuSamplesAreDroppedAndALoopStartsAnew) {
  Inbox inbox(InboxParams{});
  inbox.addImu(imuAt(20.0));
  inbox.addImu(imuAt(19.9));
  EXPECT_EQ(inbox.imuDropped(), 1u);
  inbox.addImu(imuAt(1.0));
  inbox.addImu(imuAt(1.1));
  inbox.push(frameAt(1.05));
  const auto work = inbox.take(SteadyTime());
  ASSERT_TRUE(work);
  ASSERT_EQ(work->imu.size(), 2u);
  EXPECT_EQ(work->imu.front().time_s, 1.0);
  EXPECT_EQ(inbox.imuDropped(), 2u);
}

TEST(Inbox, WaitAndTakeHandsOverBetweenThreadsAndStops) {
  Inbox inbox(InboxParams{});
  std::thread feeder([&inbox] {
    inbox.push(frameAt(10.0, std::chrono::steady_clock::now()));
    inbox.addImu(imuAt(10.1));
  });
  EXPECT_TRUE(inbox.waitAndTake());
  feeder.join();
  std::thread stopper([&inbox] { inbox.stop(); });
  EXPECT_FALSE(inbox.waitAndTake());
  stopper.join();
}

}  // namespace
}  // namespace stereo_nav::ros_io
