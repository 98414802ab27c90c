// Runs inside the virtual machine of vm.sh, beside a ROS master: the README's way from two webcams to an
// image on the screen.
#include <gtest/gtest.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <regex>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/foreign_program.h"
#include "support/node_process.h"
#include "support/virtual_screen.h"
#include "v4l2/ros_probe.h"

namespace stereo_nav::test {
namespace {

/// vivid shows eight vertical bars; these are the ones between the grey and the black, below the text.
std::vector<cv::Scalar> colouredBars(const sensor_msgs::Image& image) {
  std::vector<cv::Scalar> bars;
  const std::size_t row = image.height - image.height / 16;
  for (std::size_t bar = 1; bar < 7; ++bar) {
    const std::uint8_t* pixel = image.data.data() + row * image.step + 3 * ((2 * bar + 1) * image.width / 16);
    bars.emplace_back(pixel[0], pixel[1], pixel[2]);
  }
  return bars;
}

/// Where on the screen a colour is, px from the left on average; negative when it is hardly there.
double columnOf(const cv::Scalar& colour, const cv::Mat& screen) {
  cv::Mat mask;
  cv::inRange(screen, colour - cv::Scalar(3, 3, 3, 0), colour + cv::Scalar(3, 3, 3, 255), mask);
  const cv::Moments moments = cv::moments(mask, true);
  constexpr double kFewest_px = 500;
  return moments.m00 < kFewest_px ? -1.0 : moments.m10 / moments.m00;
}

bool showsInOrder(const cv::Mat& screen, const std::vector<cv::Scalar>& bars) {
  std::vector<double> columns;
  for (const auto& bar : bars) columns.push_back(columnOf(bar, screen));
  return columns.front() >= 0.0 &&
         std::adjacent_find(columns.begin(), columns.end(), std::greater_equal<>()) == columns.end();
}

TEST(FirstImages, ListedCamerasAreLaunchedAndSeenOnTheScreen) {
  if (!VirtualScreen::available()) GTEST_SKIP() << "Xvfb or xdotool is not installed";
  if (!std::filesystem::exists("/usr/lib/image_view/image_view"))
    GTEST_SKIP() << "image_view is not installed";
  const VirtualScreen screen("/tmp");

  const std::string listed = runCommand("rosrun stereo_nav list_cameras").output;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      listed, found, std::regex("roslaunch stereo_nav capture.launch (left:=[^ ]+) (right:=[^ \n]+)")))
      << listed;
  // An emulated machine cannot draw, convert and show more.
  std::ofstream("/tmp/slow_cameras.yaml")
      << "width: 320\nheight: 180\nrate_hz: 2.0\nmax_time_offset_s: 0.25\n";
  Topic<sensor_msgs::Image> left("camera/left/image_raw");
  const NodeProcess launch({"/usr/bin/roslaunch", CAPTURE_LAUNCH, found[1], found[2],
                            "config:=/tmp/slow_cameras.yaml", "load_image_proc:=false"});
  ForeignProgram viewer("image_view",
                        "exec /usr/bin/rosrun image_view image_view image:=/camera/left/image_raw");
  ASSERT_TRUE(comesTrue([&] { return !left.messages.empty(); }));
  ASSERT_EQ(left.messages.back()->encoding, "bgr8");

  const auto bars = colouredBars(*left.messages.back());
  cv::Mat seen;
  const auto look = [&] {
    seen = screen.pixels();
    return showsInOrder(seen, bars);
  };
  ASSERT_TRUE(viewer.comesUp(look, 300.0)) << viewer.command().output();
  const cv::Mat before = seen;
  EXPECT_TRUE(comesTrue([&] { return look() && cv::norm(before, seen, cv::NORM_INF) > 0.0; }, 300.0, 1.0))
      << "the image stands still";
}

}  // namespace
}  // namespace stereo_nav::test
