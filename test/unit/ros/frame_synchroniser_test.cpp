#include "ros/frame_synchroniser.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

namespace stereo_nav::ros_io {
namespace {

using Disparity = odometry::DisparityUse;

ros::Time at(double time_s) {
  return ros::Time(1000.0 + time_s);
}

class Feed {
 public:
  explicit Feed(Disparity disparity = Disparity::kMatched, double rolling_shutter_ms = 0.0)
      : synchroniser(makeParams(disparity, rolling_shutter_ms)) {}

  void left(double time_s) { synchroniser.addLeft(image(time_s), SteadyTime()); }
  void right(double time_s) { synchroniser.addRight(image(time_s)); }
  void disparity(double time_s) {
    auto message = boost::make_shared<stereo_msgs::DisparityImage>();
    message->header.stamp = at(time_s);
    synchroniser.addDisparity(message);
  }
  void sync(double time_s, double skew_s) {
    auto message = boost::make_shared<StereoSync>();
    message->header.stamp = message->left_stamp = at(time_s);
    message->right_stamp = at(time_s + skew_s);
    message->rolling_shutter_s = 0.03;
    synchroniser.addSync(message);
  }

  FrameSynchroniser synchroniser;

 private:
  static FrameSynchroniserParams makeParams(Disparity disparity, double rolling_shutter_ms) {
    FrameSynchroniserParams params;
    params.rolling_shutter_ms = rolling_shutter_ms;
    params.queue_size = 4;
    params.disparity = disparity;
    return params;
  }
  static sensor_msgs::ImageConstPtr image(double time_s) {
    auto message = boost::make_shared<sensor_msgs::Image>();
    message->header.stamp = at(time_s);
    return message;
  }
};

TEST(FrameSynchroniser, EqualStampsCompleteAtOnceInAnyOrder) {
  Feed feed;
  feed.disparity(0.0);
  feed.right(0.0);
  EXPECT_FALSE(feed.synchroniser.take());
  feed.left(0.0);
  const auto frame = feed.synchroniser.take();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->left_stamp, at(0.0));
  EXPECT_EQ(frame->right_stamp, at(0.0));
  EXPECT_EQ(frame->disparity->header.stamp, at(0.0));
  EXPECT_EQ(frame->rolling_shutter_s, 0.0) << "nobody says that there is one";
  EXPECT_FALSE(frame->after_jump);
  EXPECT_FALSE(feed.synchroniser.take());
  EXPECT_EQ(feed.synchroniser.dropped(), 0u);
}

TEST(FrameSynchroniser, OnlyTheDisparityOfTheSameStampBelongs) {
  Feed feed;
  feed.left(0.1);
  feed.right(0.1);
  feed.disparity(0.0);
  EXPECT_FALSE(feed.synchroniser.take());
  feed.disparity(0.1);
  EXPECT_TRUE(feed.synchroniser.take());
}

TEST(FrameSynchroniser, LatestTakesTheNewestMapThereIs) {
  Feed feed(Disparity::kLatest);
  feed.left(0.0);
  feed.right(0.0);
  auto frame = feed.synchroniser.take();
  ASSERT_TRUE(frame);
  EXPECT_FALSE(frame->disparity);
  feed.disparity(0.0);
  feed.left(0.1);
  feed.right(0.1);
  frame = feed.synchroniser.take();
  ASSERT_TRUE(frame);
  ASSERT_TRUE(frame->disparity);
  EXPECT_EQ(frame->disparity->header.stamp, at(0.0));
}

TEST(FrameSynchroniser, NearestRightImageWithoutSyncMessages) {
  Feed feed(Disparity::kNone);
  for (int i = 0; i < 3; ++i) {  // the right camera 5 ms behind, 100 ms period
    feed.left(0.1 * i);
    EXPECT_FALSE(feed.synchroniser.take()) << "the right image is still to come";
    feed.right(0.1 * i + 0.005);
    const auto frame = feed.synchroniser.take();
    ASSERT_TRUE(frame);
    EXPECT_NEAR((frame->right_stamp - frame->left_stamp).toSec(), 0.005, 1e-6);
  }
}

TEST(FrameSynchroniser, AnEarlierRightImageIsTakenWithoutWaitingForTheNextOne) {
  Feed feed(Disparity::kNone);
  feed.right(-0.105);
  feed.right(-0.005);  // from here the period of the right camera is known
  feed.left(0.0);
  const auto frame = feed.synchroniser.take();
  ASSERT_TRUE(frame);
  EXPECT_NEAR((frame->right_stamp - frame->left_stamp).toSec(), -0.005, 1e-6);
}

TEST(FrameSynchroniser, ARightImageBeyondTheSkewIsNoPartner) {
  Feed feed(Disparity::kNone);
  feed.left(0.0);
  feed.right(0.07);
  EXPECT_FALSE(feed.synchroniser.take());
  EXPECT_EQ(feed.synchroniser.dropped(), 1u);
}

TEST(FrameSynchroniser, ARollingShutterStaysOneWhenSyncGoesQuiet) {
  Feed feed(Disparity::kNone, 20.0);
  const auto readoutAt = [&](double time_s) {
    feed.left(time_s);
    feed.right(time_s);
    const auto frame = feed.synchroniser.take();
    return frame ? frame->rolling_shutter_s : -1.0;
  };
  EXPECT_DOUBLE_EQ(readoutAt(0.0), 0.02) << "what the parameter says until camera/sync comes";
  feed.sync(0.1, 0.0);
  EXPECT_DOUBLE_EQ(readoutAt(0.1), 0.03);
  EXPECT_DOUBLE_EQ(readoutAt(10.0), 0.03);
}

TEST(FrameSynchroniser, SyncNamesTheRightImage) {
  Feed common(Disparity::kNone);  // both images carry the common stamp
  common.sync(0.0, 0.012);
  common.left(0.0);
  common.right(0.0);
  auto frame = common.synchroniser.take();
  ASSERT_TRUE(frame);
  EXPECT_NEAR((frame->right_stamp - frame->left_stamp).toSec(), 0.012, 1e-6);
  EXPECT_EQ(frame->rolling_shutter_s, 0.03);

  Feed own(Disparity::kNone);  // each image carries its own; a nearer one is not what was paired
  own.sync(0.0, 0.05);
  own.left(0.0);
  own.right(-0.05);
  own.right(0.02);
  EXPECT_FALSE(own.synchroniser.take());
  own.right(0.05);
  frame = own.synchroniser.take();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->right->header.stamp, at(0.05));
}

TEST(FrameSynchroniser, SyncMessagesThatStopDoNotStopTheFrames) {
  Feed feed(Disparity::kNone);
  feed.sync(0.0, 0.0);
  feed.left(2.0);
  feed.right(2.0);
  EXPECT_TRUE(feed.synchroniser.take());
}

TEST(FrameSynchroniser, ACompleteFrameOvertakesOlderOnes) {
  Feed feed;
  feed.left(0.0);
  feed.right(0.0);
  feed.left(0.1);
  feed.right(0.1);
  feed.disparity(0.1);
  const auto frame = feed.synchroniser.take();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->left_stamp, at(0.1));
  EXPECT_EQ(feed.synchroniser.dropped(), 1u);
  feed.disparity(0.0);
  EXPECT_FALSE(feed.synchroniser.take());
}

TEST(FrameSynchroniser, QueuesAreBoundedAndDropsCounted) {
  Feed feed;
  for (int i = 0; i < 10; ++i) feed.left(0.1 * i);
  EXPECT_EQ(feed.synchroniser.dropped(), 6u);
  feed.left(0.85);  // out of order
  EXPECT_EQ(feed.synchroniser.dropped(), 7u);
}

TEST(FrameSynchroniser, ALoopingBagContinuesAndIsMarked) {
  Feed feed;
  const auto frameAt = [&feed](double time_s) {
    feed.left(time_s);
    feed.right(time_s);
    feed.disparity(time_s);
    return feed.synchroniser.take();
  };
  ASSERT_TRUE(frameAt(5.0));
  // The last disparity of the old round comes after the first image of the new one.
  feed.left(5.1);
  feed.right(5.1);
  feed.left(0.0);
  feed.disparity(5.1);
  feed.right(0.0);
  feed.disparity(0.0);
  const auto frame = feed.synchroniser.take();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->left_stamp, at(0.0));
  EXPECT_TRUE(frame->after_jump);
  EXPECT_EQ(feed.synchroniser.dropped(), 1u);
  const auto next = frameAt(0.1);
  ASSERT_TRUE(next);
  EXPECT_FALSE(next->after_jump);
}

}  // namespace
}  // namespace stereo_nav::ros_io
