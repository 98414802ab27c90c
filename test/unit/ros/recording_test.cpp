#include "stereo_nav/ros/recording.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/String.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"
#include "support/fixture_bag.h"
#include "support/text.h"
#include "unit/ros/bag_copy.h"

namespace stereo_nav::ros_io {
namespace {

namespace fs = std::filesystem;

class RecordingTest : public ::testing::Test {
 protected:
  RecordingTest() : folder_(fs::temp_directory_path() / ("recording_test_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~RecordingTest() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  static std::string refusal(const std::string& bag) {
    try {
      const Recording recording(bag, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

 private:
  fs::path folder_;
};

TEST_F(RecordingTest, DeliversEveryPairInOrderWithItsTrueTimes) {
  test::FixtureBag fixture;
  fixture.frames = 5;
  fixture.right_lag_s = 0.05;
  test::writeFixtureBag(path("lag.bag"), fixture);
  const Recording recording(path("lag.bag"), {});
  ASSERT_EQ(recording.pairs(), 5u);
  EXPECT_EQ(recording.unpairedImages(), 0u);
  std::vector<double> left_times_s;
  recording.forEachPair([&](const RawPair& pair) {
    EXPECT_EQ(pair.left.size(), cv::Size(320, 240));
    EXPECT_NEAR(pair.right_time_s - pair.left_time_s, 0.05, 1e-6);
    left_times_s.push_back(pair.left_time_s);
  });
  ASSERT_EQ(left_times_s.size(), 5u);
  EXPECT_TRUE(std::is_sorted(left_times_s.begin(), left_times_s.end()));
}

TEST_F(RecordingTest, TheRollingShutterMayBeToldByTheUser) {
  test::FixtureBag fixture;
  fixture.frames = 2;
  test::writeFixtureBag(path("rolling.bag"), fixture);
  RecordingOptions options;
  options.rolling_shutter_s = 0.025;
  Recording(path("rolling.bag"), options).forEachPair([](const RawPair& pair) {
    EXPECT_EQ(pair.rolling_shutter_s, 0.025);
  });
  Recording(path("rolling.bag"), {}).forEachPair([](const RawPair& pair) {
    EXPECT_EQ(pair.rolling_shutter_s, 0.0) << "what camera/sync says";
  });
}

TEST_F(RecordingTest, SyncMessagesThatItCannotReadAreNotPassedOver) {
  test::FixtureBag fixture;
  fixture.frames = 2;
  test::writeFixtureBag(path("old.bag"), fixture);
  {
    rosbag::Bag bag(path("old.bag"), rosbag::bagmode::Append);
    bag.write(topics::kSync, ros::Time(1.0), std_msgs::String());
  }
  const std::string message = refusal(path("old.bag"));
  EXPECT_TRUE(contains(message, "of another version of stereo_nav")) << message;
}

TEST_F(RecordingTest, StartAndDurationCutAPiece) {
  test::FixtureBag fixture;
  fixture.frames = 6;
  test::writeFixtureBag(path("part.bag"), fixture);
  RecordingOptions part;
  part.start_s = 0.15;
  part.duration_s = 0.2;
  const Recording recording(path("part.bag"), part);
  EXPECT_EQ(recording.pairs(), 2u);  // 0.2 s and 0.3 s
  part.start_s = 100.0;
  EXPECT_THROW(Recording(path("part.bag"), part), InputError);
}

TEST_F(RecordingTest, ReadsTransformsImuAndGroundTruth) {
  test::FixtureBag fixture;
  fixture.frames = 2;
  test::writeFixtureBag(path("all.bag"), fixture);
  const Recording recording(path("all.bag"), {});
  const auto T_base_camera = recording.transform("base_link", "camera_left_optical");
  ASSERT_TRUE(T_base_camera);
  EXPECT_NEAR(T_base_camera->translation().z(), 0.283, 1e-12);
  // The optical axis points forward.
  EXPECT_TRUE((T_base_camera->linear() * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_FALSE(recording.transform("base_link", "lidar"));
  EXPECT_EQ(recording.imuFrame(), "imu_link");
  EXPECT_GT(recording.imu().size(), 15u);
  const auto truth = recording.groundTruth("ground_truth/odom", true);
  EXPECT_GT(truth.trajectory.size(), 15u);
  EXPECT_EQ(truth.body_frame, "base_link");
  EXPECT_TRUE(recording.groundTruth("somewhere/else", false).trajectory.empty());
  EXPECT_THROW(recording.groundTruth("somewhere/else", true), InputError);
}

TEST_F(RecordingTest, SaysWhatIsWrongWithAFileThatIsNoRecording) {
  EXPECT_TRUE(contains(refusal(path("missing.bag")), "missing.bag: cannot be read"));
  std::ofstream(path("text.bag")) << "this is not a bag";
  EXPECT_TRUE(contains(refusal(path("text.bag")), "cannot be read"));
}

TEST_F(RecordingTest, NamesTheTopicsItFoundWhenOneIsMissing) {
  {
    rosbag::Bag bag(path("other.bag"), rosbag::bagmode::Write);
    bag.write("chatter", ros::Time(1.0), std_msgs::String());
  }
  const std::string message = refusal(path("other.bag"));
  EXPECT_TRUE(contains(message, "no topic camera/left/image_raw")) << message;
  EXPECT_TRUE(contains(message, "the bag holds chatter")) << message;
}

TEST_F(RecordingTest, OneCameraOnlyIsRefused) {
  {
    rosbag::Bag bag(path("left.bag"), rosbag::bagmode::Write);
    bag.write(topics::kLeftImage, ros::Time(1.0), sensor_msgs::Image());
    bag.write(topics::kLeftInfo, ros::Time(1.0), sensor_msgs::CameraInfo());
  }
  EXPECT_TRUE(contains(refusal(path("left.bag")), "no topic camera/right/image_raw"));
}

TEST_F(RecordingTest, ANaNInTheImuIsRefused) {
  test::FixtureBag fixture;
  fixture.frames = 2;
  fixture.with_imu = false;
  test::writeFixtureBag(path("nan.bag"), fixture);
  {
    rosbag::Bag bag(path("nan.bag"), rosbag::bagmode::Append);
    sensor_msgs::Imu imu;
    imu.header.stamp = ros::Time(1000.0);
    imu.angular_velocity.x = std::numeric_limits<double>::quiet_NaN();
    bag.write(topics::kImu, ros::Time(1000.0), imu);
  }
  EXPECT_TRUE(contains(refusal(path("nan.bag")), "imu/data holds a NaN"));
}

TEST_F(RecordingTest, SeveralRigsAreListedAndOneCanBeChosen) {
  test::FixtureBag fixture;
  fixture.frames = 2;
  test::writeFixtureBag(path("one.bag"), fixture);
  const auto below = [](const std::string& space, const std::string& left_out) {
    return [=](const std::string& topic) {
      const std::string name = topic.front() == '/' ? topic.substr(1) : topic;
      return name == left_out ? std::string() : name == topics::kTfStatic ? topic : space + name;
    };
  };
  const auto keep = [](sensor_msgs::Image&) {};
  test::copyBag(path("one.bag"), path("two.bag"), rosbag::bagmode::Write, below("/a/", topics::kLeftInfo),
                keep);
  test::copyBag(path("one.bag"), path("two.bag"), rosbag::bagmode::Append, below("/b/", ""), keep);
  const std::string message = refusal(path("two.bag"));
  EXPECT_TRUE(contains(message, "/a (lacks camera/left/camera_info), /b; choose one of them by --namespace"))
      << message;
  RecordingOptions options;
  options.rig = "/b";
  EXPECT_EQ(Recording(path("two.bag"), options).pairs(), 2u);
  options.rig = "a";
  EXPECT_THROW(Recording(path("two.bag"), options), InputError) << "its calibration would be that of /b";
  options.rig = "c";
  EXPECT_THROW(Recording(path("two.bag"), options), InputError);
}

TEST_F(RecordingTest, Mono16OfTwelveBitsIsAsBrightAsMono8) {
  test::FixtureBag fixture;
  fixture.frames = 2;
  test::writeFixtureBag(path("eight.bag"), fixture);
  for (const bool big_endian : {false, true}) {
    test::copyBag(
        path("eight.bag"), path("twelve.bag"), rosbag::bagmode::Write, [](const std::string& t) { return t; },
        [&](sensor_msgs::Image& image) {
          std::vector<std::uint8_t> data;
          for (const std::uint8_t grey : image.data) {
            const int value = 16 * grey;
            data.push_back(static_cast<std::uint8_t>(big_endian ? value >> 8 : value & 0xff));
            data.push_back(static_cast<std::uint8_t>(big_endian ? value & 0xff : value >> 8));
          }
          image.data = data;
          image.encoding = "mono16";
          image.step *= 2;
          image.is_bigendian = 0;  // wrong for one of the two
        });
    std::vector<cv::Mat> expected, images;
    Recording(path("eight.bag"), {}).forEachPair([&](const RawPair& pair) {
      expected.push_back(pair.left.clone());
    });
    Recording(path("twelve.bag"), {}).forEachPair([&](const RawPair& pair) {
      images.push_back(pair.left.clone());
    });
    ASSERT_EQ(images.size(), expected.size());
    EXPECT_LE(cv::norm(images[0], expected[0], cv::NORM_INF), 1.0) << big_endian;
  }
}

}  // namespace
}  // namespace stereo_nav::ros_io
