// Bags whose recorder's clock was set back: rosbag's order by receipt is not that of recording.
#include "stereo_nav/ros/recorded_order.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/UInt32.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

namespace stereo_nav::ros_io {
namespace {

namespace fs = std::filesystem;

struct ReadMessage {
  std::string topic;
  std::uint32_t number;
  double received_s;
};

/// Messages `images` at 10 Hz, numbered from 0, and `imu` at 100 Hz, numbered by tens of milliseconds.
class RecordedOrderTest : public ::testing::Test {
 protected:
  void TearDown() override { fs::remove(path_); }

  /// `recorder_s` is what the recorder's clock shows `true_s` after 100 s.
  template <class RecorderClock>
  void record(double duration_s, const RecorderClock& recorder_s) {
    rosbag::Bag bag(path_.string(), rosbag::bagmode::Write);
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(100.0 * duration_s + 0.5); ++i) {
      std_msgs::UInt32 message;
      const ros::Time received(100.0 + recorder_s(0.01 * i));
      message.data = i;
      bag.write("imu", received, message);
      message.data = i / 10;
      if (i % 10 == 0) bag.write("images", received, message);
    }
  }

  std::vector<ReadMessage> read(std::size_t set_backs) const {
    const rosbag::Bag bag(path_.string(), rosbag::bagmode::Read);
    const RecordedOrder order(bag, "images");
    EXPECT_EQ(order.setBacks(), set_backs);
    std::vector<ReadMessage> messages;
    order.forEach(bag, {"images", "imu"}, [&](const rosbag::MessageInstance& message, const ros::Time& at) {
      messages.push_back(
          {message.getTopic(), message.instantiate<std_msgs::UInt32>()->data, at.toSec() - 100.0});
    });
    return messages;
  }

  /// Every message, each topic in its order, at the time at which it was really received.
  static void expectTrueOrder(const std::vector<ReadMessage>& messages, std::uint32_t images) {
    std::uint32_t image = 0, sample = 0;
    for (const ReadMessage& message : messages) {
      const bool is_image = message.topic == "images";
      EXPECT_EQ(message.number, is_image ? image++ : sample++);
      EXPECT_NEAR(message.received_s, (is_image ? 0.1 : 0.01) * message.number, 1e-6);
    }
    EXPECT_EQ(image, images);
    EXPECT_EQ(sample, 10 * images);
  }

  fs::path path_ = fs::temp_directory_path() / ("recorded_order_" + std::to_string(getpid()) + ".bag");
};

TEST_F(RecordedOrderTest, AClockThatRunsOnGivesTheTimesOfReceipt) {
  record(3.0, [](double true_s) { return true_s; });
  expectTrueOrder(read(0), 30);
}

TEST_F(RecordedOrderTest, AClockThatIsSetBackIsUndone) {
  record(4.0, [](double true_s) { return true_s < 1.995 ? true_s : true_s - 1.0; });
  expectTrueOrder(read(1), 40);
}

TEST_F(RecordedOrderTest, SoIsOneThatIsSetBackTwice) {
  record(6.0, [](double true_s) { return true_s - (true_s < 1.995 ? 0.0 : true_s < 3.995 ? 0.7 : 1.2); });
  expectTrueOrder(read(2), 60);
}

TEST_F(RecordedOrderTest, PartsOfAMergedBagKeepTheirTimes) {
  record(4.0, [](double true_s) { return true_s < 1.995 ? true_s : true_s - 50.0; });
  const auto messages = read(0);
  ASSERT_EQ(messages.size(), 440u);
  EXPECT_NEAR(messages.front().received_s, -48.0, 1e-6);
  EXPECT_NEAR(messages.back().received_s, 1.99, 1e-6);
}

}  // namespace
}  // namespace stereo_nav::ros_io
