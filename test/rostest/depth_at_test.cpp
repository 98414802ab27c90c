// depth_at on live topics whose distances are known: at a given pixel, and at clicked ones.
#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <stereo_msgs/DisparityImage.h>

#include <algorithm>
#include <cstdlib>
#include <future>

#include "support/command.h"

namespace stereo_nav::test {
namespace {

/// Two walls side by side, at 2 m (left) and 4 m, and a piece without disparity.
class Walls {
 public:
  Walls()
      : disparity_(handle_.advertise<stereo_msgs::DisparityImage>("camera/disparity", 10)),
        image_(handle_.advertise<sensor_msgs::Image>("camera/left/image_rect", 10)) {
    cv::Mat map(240, 320, CV_32FC1, cv::Scalar(20.0));
    map.colRange(160, 320).setTo(10.0);
    map(cv::Rect(20, 180, 40, 40)).setTo(-1.0);
    map.at<float>(100, 50) = 5.0f;  // an outlier that the median takes no notice of
    message_.f = 400.0f;
    message_.T = 0.1f;
    message_.min_disparity = 0.0f;
    cv_bridge::CvImage(std_msgs::Header(), "32FC1", map).toImageMsg(message_.image);
    cv_bridge::CvImage(std_msgs::Header(), "mono8", cv::Mat(240, 320, CV_8UC1, cv::Scalar(90)))
        .toImageMsg(picture_);
  }

  /// Publishes until the command has ended.
  CommandResult show(const std::string& command) {
    auto result = std::async(std::launch::async, [command] { return runCommand(command); });
    while (result.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
      message_.header.stamp = message_.image.header.stamp = picture_.header.stamp = ros::Time::now();
      disparity_.publish(message_);
      image_.publish(picture_);
      ros::spinOnce();
    }
    return result.get();
  }

 private:
  ros::NodeHandle handle_;
  ros::Publisher disparity_, image_;
  stereo_msgs::DisparityImage message_;
  sensor_msgs::Image picture_;
};

const std::string kDepthAt = std::string(DEPTH_AT) + " --live ";

TEST(DepthAt, GivenPixel) {
  const CommandResult result = Walls().show(kDepthAt + "--pixel 50 100 --frames 7 --each");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 8) << result.output;
  EXPECT_NE(result.output.find(
                "pixel (50, 100): mean 2.000 m, standard deviation 0.000 m, from 2.000 to 2.000 m, in 7 of 7 "
                "frames"),
            std::string::npos)
      << result.output;
}

TEST(DepthAt, PixelWithoutDisparityOrOutside) {
  Walls walls;
  const CommandResult none = walls.show(kDepthAt + "--pixel 40 200 --frames 3");
  EXPECT_NE(none.output.find("no disparity at the pixel in any of 3 frames"), std::string::npos)
      << none.output;
  const CommandResult outside = walls.show(kDepthAt + "--pixel 319 100");
  EXPECT_EQ(outside.status, 2);
  EXPECT_NE(outside.output.find("leaves the image of 320 x 240"), std::string::npos) << outside.output;
}

TEST(DepthAt, BadArguments) {
  for (const char* arguments :
       {"", "--live x.bag --pixel 1 1", "x.bag", "--live --pixel 1", "--live --frames 0"}) {
    const CommandResult result = runCommand(std::string(DEPTH_AT) + " " + arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_EQ(result.output.rfind("depth_at: ", 0), 0u) << result.output;
  }
}

TEST(DepthAt, ClickedPixels) {
  if (std::system("command -v xvfb-run xdotool > /dev/null") != 0) GTEST_SKIP() << "no xvfb-run and xdotool";
  // A click into each wall, then a key. The image fills the window. A window that has just come up may miss a
  // click, which is made again after two seconds then.
  const std::string script =
      "set -e; output=$(mktemp); " + kDepthAt +
      "--frames 4 > $output & window=$(xdotool search --sync --name 'depth_at' | tail -1); click() "
      "{ for i in $(seq 100); do [ $((i % 10)) != 1 ] || xdotool mousemove --window $window $1 $2 click 1; "
      "grep -q \"($1, $2)\" $output && return; sleep 0.2; done; }; "
      "click 50 100; click 250 60; xdotool key --window $window q; "
      "for i in $(seq 100); do kill -0 $! 2>/dev/null || break; sleep 0.2; done; kill $! 2>/dev/null || "
      "true; cat $output; rm $output";
  const CommandResult result = Walls().show("xvfb-run -a bash -c '" + script + "'");
  EXPECT_NE(result.output.find("pixel (50, 100): mean 2.000 m"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("pixel (250, 60): mean 4.000 m"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace stereo_nav::test
