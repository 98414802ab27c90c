// docs/calibration.md from calibrate.launch to check_calibration, without cameras: the launch file as it is,
// pictures of a board on the cameras' topics, the calibrator's window on a virtual screen, its buttons
// pressed by the mouse. Started by calibrate.test, which says where its files go.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "stereo_nav/core/parameters.h"
#include "support/command.h"
#include "support/ros_wait.h"
#include "support/virtual_screen.h"
#include "v4l2/checkerboard.h"

namespace stereo_nav::test {
namespace {

namespace fs = std::filesystem;
std::string calibrationFolder() {
  return ros::param::param<std::string>("~folder", "");
}
constexpr const char* kSaved = "/tmp/calibrationdata.tar.gz";  // camera_calibration's own choice

/// Publishes the board, which wanders through the view, as two free-running cameras.
class BoardPublisher {
 public:
  void publishNext() {
    const ros::Time stamp = ros::Time::now();
    left_.publish(message(rig.draw(moment_, 0.0), stamp));
    right_.publish(message(rig.draw(moment_, rig.baseline_m), stamp + ros::Duration(0.01)));
    left_info_.publish(info(0.0));
    right_info_.publish(info(rig.baseline_m));
    moment_ += 1.0;
  }
  bool isHeard() const { return left_.getNumSubscribers() > 0 && right_.getNumSubscribers() > 0; }

  const CheckerboardRig rig;

 private:
  static sensor_msgs::Image message(const cv::Mat& image, const ros::Time& stamp) {
    sensor_msgs::Image message;
    message.header.stamp = stamp;
    message.header.frame_id = "camera_left_optical";
    message.width = static_cast<std::uint32_t>(image.cols);
    message.height = static_cast<std::uint32_t>(image.rows);
    message.step = message.width;
    message.encoding = "mono8";
    message.data.assign(image.data, image.data + image.total());
    return message;
  }

  /// The true calibration.
  sensor_msgs::CameraInfo info(double camera_x_m) const {
    sensor_msgs::CameraInfo info;
    info.header.frame_id = "camera_left_optical";
    info.width = static_cast<std::uint32_t>(rig.width);
    info.height = static_cast<std::uint32_t>(rig.height);
    info.distortion_model = "plumb_bob";
    info.D.assign(5, 0.0);
    const double f = rig.focal_length_px, cx = 0.5 * rig.width, cy = 0.5 * rig.height;
    info.K = {f, 0, cx, 0, f, cy, 0, 0, 1};
    info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    info.P = {f, 0, cx, -f * camera_x_m, 0, f, cy, 0, 0, 0, 1, 0};
    return info;
  }

  ros::NodeHandle handle_;
  ros::Publisher left_info_ = handle_.advertise<sensor_msgs::CameraInfo>("camera/left/camera_info", 2);
  ros::Publisher right_info_ = handle_.advertise<sensor_msgs::CameraInfo>("camera/right/camera_info", 2);
  ros::Publisher left_ = handle_.advertise<sensor_msgs::Image>("camera/left/image_raw", 2);
  ros::Publisher right_ = handle_.advertise<sensor_msgs::Image>("camera/right/image_raw", 2);
  double moment_ = 0.0;
};

/// Middles of the lit buttons, from top to bottom: CALIBRATE, then SAVE and COMMIT as well.
std::vector<cv::Point> litButtons(const VirtualScreen& screen) {
  cv::Mat lit, labels, statistics, centres;
  cv::inRange(screen.pixels(), cv::Scalar(155, 155, 80, 0), cv::Scalar(155, 155, 80, 255), lit);
  const int count = cv::connectedComponentsWithStats(lit, labels, statistics, centres);
  std::vector<cv::Point> buttons;
  constexpr int kLeastArea = 200;
  for (int i = 1; i < count; ++i) {
    if (statistics.at<int>(i, cv::CC_STAT_AREA) < kLeastArea) continue;
    buttons.emplace_back(static_cast<int>(centres.at<double>(i, 0)),
                         static_cast<int>(centres.at<double>(i, 1)));
  }
  std::sort(buttons.begin(), buttons.end(), [](const cv::Point& a, const cv::Point& b) { return a.y < b.y; });
  return buttons;
}

/// Shows the board until the launch file has ended, and presses what is lit.
class User {
 public:
  User(const VirtualScreen& screen, BoardPublisher& board) : screen_(screen), board_(board) {}

  /// False when it has not ended within `limit_s`.
  bool calibrateUntilEnd(NodeProcess& launched, double limit_s) {
    const auto endsMeanwhile = [&] {
      if (launched.ended()) return true;
      board_.publishNext();
      pressWhatIsLit();
      return false;
    };
    return spinUntil(endsMeanwhile, limit_s, 0.3);
  }

  bool pressed_calibrate = false, pressed_save = false, pressed_commit = false;

 private:
  void pressWhatIsLit() {
    const auto buttons = litButtons(screen_);
    if (buttons.size() == 1 && !pressed_calibrate) press(buttons[0], pressed_calibrate);
    if (buttons.size() != 3) return;
    if (!pressed_save) {
      press(buttons[1], pressed_save);
    } else if (fs::exists(kSaved) && !pressed_commit) {
      press(buttons[2], pressed_commit);
    }
  }
  void press(const cv::Point& button, bool& pressed) {
    screen_.click(button.x, button.y);
    pressed = true;
  }

  const VirtualScreen& screen_;
  BoardPublisher& board_;
};

CommandResult checkCalibration(const std::string& arguments) {
  return runCommand(std::string(CHECK_CALIBRATION) + " " + arguments);
}

class CalibrateLaunch : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!VirtualScreen::available()) GTEST_SKIP() << "Xvfb or xdotool is not installed";
    fs::remove_all(folder_);  // of an earlier run
    fs::create_directories(folder_);
    // A calibration that the user has saved there is kept.
    if (fs::exists(kSaved)) fs::rename(kSaved, kept_);
  }
  void TearDown() override {
    if (fs::exists(kSaved)) fs::remove(kSaved);
    if (fs::exists(kept_)) fs::rename(kept_, kSaved);
  }

  const std::string folder_ = calibrationFolder();
  const std::string kept_ = std::string(kSaved) + ".kept_by_test";
};

TEST_F(CalibrateLaunch, TheButtonsLeadToASavedCalibrationThatIsGood) {
  const std::string config = folder_ + "/capture.yaml";
  std::ofstream(config) << "width: 320\nheight: 240\n";
  const VirtualScreen screen(folder_);
  BoardPublisher board;
  NodeProcess launched({"/usr/bin/env", "roslaunch", LAUNCH_FOLDER "/calibrate.launch",
                        "left:=/dev/v4l/by-path/no-left-camera", "right:=/dev/v4l/by-path/no-right-camera",
                        "square:=0.051", "config:=" + config,
                        "left_calibration:=file://" + folder_ + "/left.yaml",
                        "right_calibration:=file://" + folder_ + "/right.yaml"});
  for (const std::string side : {"left", "right"}) {
    EXPECT_TRUE(ros::service::waitForService("camera/" + side + "/set_camera_info", ros::Duration(60)));
  }
  // `_stamps:=true` of the command line is a bool there until the node has started its services and writes
  // back what it has read, which is text.
  std::string stamps;
  spinUntil([&stamps] { return ros::param::get("stereo_capture/stamps", stamps); }, kLongWait_s, 0.1);
  EXPECT_EQ(stamps, "true") << "the calibrator needs each image's own time";

  User user(screen, board);
  const bool ended = user.calibrateUntilEnd(launched, 300.0);
  if (!ended) cv::imwrite(folder_ + "/screen.png", screen.pixels());
  ASSERT_TRUE(ended) << "CALIBRATE " << user.pressed_calibrate << ", SAVE " << user.pressed_save
                     << ", COMMIT " << user.pressed_commit << ", the calibrator listens: " << board.isHeard()
                     << "; what was on the screen is in " << folder_ << "/screen.png";
  EXPECT_TRUE(user.pressed_commit);

  // The capture node has saved what COMMIT sent.
  const YAML::Node left = loadYamlFile(folder_ + "/left.yaml"), right = loadYamlFile(folder_ + "/right.yaml");
  const double focal_length_px = left["camera_matrix"]["data"][0].as<double>();
  EXPECT_NEAR(focal_length_px, board.rig.focal_length_px, 0.03 * board.rig.focal_length_px);
  const auto P = right["projection_matrix"]["data"];
  EXPECT_NEAR(-P[3].as<double>() / P[0].as<double>(), board.rig.baseline_m, 0.03 * board.rig.baseline_m);

  // What SAVE wrote is what check_calibration takes.
  fs::create_directories(folder_ + "/calibration");
  ASSERT_EQ(runCommand(std::string("tar xzf ") + kSaved + " -C " + folder_ + "/calibration").status, 0);
  const CommandResult checked = checkCalibration(folder_ + "/calibration --size 8x6 --square 0.051");
  EXPECT_EQ(checked.status, 0) << checked.output;
  EXPECT_NE(checked.output.find("good: every figure"), std::string::npos) << checked.output;
  const CommandResult saved = checkCalibration(folder_ + "/calibration --calibration " + folder_);
  EXPECT_EQ(saved.status, 0) << saved.output;
}

/// Publishes the board in the background.
class RunningBoard {
 public:
  RunningBoard() = default;
  ~RunningBoard() {
    done_ = true;
    thread_.join();
  }

 private:
  BoardPublisher board_;
  std::atomic<bool> done_{false};
  std::thread thread_{[this] {
    while (!done_) {
      board_.publishNext();
      ros::WallDuration(0.2).sleep();
    }
  }};
};

void expectGoodWithTrueBaseline(const CommandResult& result) {
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("baseline 120.00 mm, focal length 417.00 px"), std::string::npos)
      << result.output;
  EXPECT_NE(result.output.find("are up to 10 ms apart"), std::string::npos) << result.output;
}

TEST(CheckCalibrationLive, TopicsAreListenedToUntilThereAreEnoughViews) {
  const RunningBoard board;
  const CommandResult result = checkCalibration("--views 6 --interval 0.2 --size 8x6 --square 0.051");
  expectGoodWithTrueBaseline(result);
  EXPECT_NE(result.output.find(": 6 of "), std::string::npos) << result.output;
}

TEST(CheckCalibrationLive, ARecordingIsMeasured) {
  const RunningBoard board;
  const std::string folder = calibrationFolder();
  fs::create_directories(folder);
  const std::string bag = folder + "/board.bag";
  const CommandResult recorded =
      runCommand("rosbag record -O " + bag +
                 " --duration=8 camera/left/image_raw camera/right/image_raw camera/left/camera_info "
                 "camera/right/camera_info");
  ASSERT_TRUE(fs::exists(bag)) << recorded.output;
  expectGoodWithTrueBaseline(checkCalibration(bag + " --size 8x6 --square 0.051"));
}

TEST(CheckCalibrationLive, SilenceIsNamed) {
  const CommandResult result = checkCalibration("camera/left/image_raw:=nowhere");
  EXPECT_EQ(result.status, 2) << result.output;
  EXPECT_NE(result.output.find("0 images on /nowhere"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("is capture.launch running"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace stereo_nav::test
