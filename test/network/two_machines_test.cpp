// A robot and a base station on a network of their own (run.sh), whose link is cut for STEREO_NAV_CUT_S (3)
// seconds. This program is a node on the base; it starts the robot's launch files and a recorder there, and
// reads what the recorder kept.
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>

#include "stereo_nav/StereoSync.h"
#include "stereo_nav/VoStatus.h"
#include "support/command.h"
#include "support/node_process.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

const double kCut_s = [] {
  const char* seconds = std::getenv("STEREO_NAV_CUT_S");
  return seconds != nullptr ? std::atof(seconds) : 3.0;
}();
// TCP sends again at 0.2, 0.6, 1.4, 3.0, 6.2, ... s after the first loss: after a cut of 3 s the next attempt
// comes within 3.2 s. The rest is for a loaded machine.
constexpr double kResume_s = 20.0;

/// A folder of this run; processes in namespaces have the same numbers in every run.
class Folder {
 public:
  Folder() {
    if (mkdtemp(path_) == nullptr) throw std::runtime_error("cannot make a folder in /tmp");
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return std::string(path_) + "/" + name; }

 private:
  char path_[32] = "/tmp/stereo_nav_network_XXXXXX";
};

/// A command on the robot, where the master runs, or on the base.
class Machine {
 public:
  Machine(std::string name, std::string address) : name_(std::move(name)), address_(std::move(address)) {}

  std::unique_ptr<NodeProcess> start(const Folder& folder, const std::vector<std::string>& command) const {
    std::vector<std::string> words = {"/usr/bin/env", "ip", "netns", "exec", name_, "env"};
    words.insert(words.end(), {"ROS_IP=" + address_, "ROS_MASTER_URI=http://10.0.0.1:11311",
                               "ROS_HOME=" + folder / ("ros_home_" + name_)});
    words.insert(words.end(), command.begin(), command.end());
    return std::make_unique<NodeProcess>(words);
  }

 private:
  std::string name_, address_;
};

const Machine kRobot("robot", "10.0.0.1");
const Machine kBase("base", "10.0.0.2");

void setLink(bool up) {
  const auto result = runCommand(std::string("ip -n air link set bridge ") + (up ? "up" : "down"));
  ASSERT_EQ(result.status, 0) << result.output;
}

/// When messages arrived on the base, and what time they are of.
class Arrivals {
 public:
  struct Arrival {
    ros::Time at;
    ros::Time stamp;
  };

  template <class Message>
  void listen(const std::string& topic) {
    auto& list = arrivals_[topic];
    const boost::function<void(const boost::shared_ptr<const Message>&)> handler =
        [&list](const boost::shared_ptr<const Message>& message) {
          list.push_back({ros::Time::now(), message->header.stamp});
        };
    subscribers_.push_back(handle_.subscribe<Message>(topic, 10, handler));
  }

  const std::vector<Arrival>& of(const std::string& topic) const { return arrivals_.at(topic); }

  /// Whether every topic has brought `count` messages made after `time`.
  bool allHave(std::size_t count, const ros::Time& time) const {
    return std::all_of(arrivals_.begin(), arrivals_.end(), [&](const auto& item) {
      const auto& list = item.second;
      return static_cast<std::size_t>(std::count_if(list.begin(), list.end(), [&](const Arrival& arrival) {
               return arrival.stamp > time;
             })) >= count;
    });
  }

  /// How many messages each topic has brought.
  std::string counts() const {
    std::ostringstream text;
    for (const auto& [topic, list] : arrivals_) text << "  " << topic << ": " << list.size() << "\n";
    return text.str();
  }

  /// Each topic's time from `link_up` to the arrival of the first message made after it.
  std::string resumption(const ros::Time& link_up) const {
    std::ostringstream text;
    for (const auto& [topic, list] : arrivals_) {
      const auto first = std::find_if(list.begin(), list.end(),
                                      [&](const Arrival& arrival) { return arrival.stamp > link_up; });
      text << "  " << topic << ": ";
      if (first == list.end()) {
        text << "never\n";
      } else {
        text << (first->at - link_up).toSec() << " s\n";
      }
    }
    return text.str();
  }

 private:
  ros::NodeHandle handle_;
  std::map<std::string, std::vector<Arrival>> arrivals_;
  std::vector<ros::Subscriber> subscribers_;
};

/// The longest time for which this program did not get to run, as a measure of how busy the machine is.
class StallMeter {
 public:
  /// To be called all the time; returns false.
  bool tick() {
    const ros::WallTime now = ros::WallTime::now();
    longest_s_ = std::max(longest_s_, (now - last_).toSec());
    last_ = now;
    return false;
  }
  double longest_s() const { return longest_s_; }

 private:
  ros::WallTime last_ = ros::WallTime::now();
  double longest_s_ = 0.0;
};

/// The stamps of one topic in a recording.
template <class Message>
std::vector<ros::Time> recordedStamps(const std::string& path, const std::string& topic) {
  rosbag::Bag bag(path, rosbag::bagmode::Read);
  std::vector<ros::Time> stamps;
  for (const auto& item : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    stamps.push_back(item.instantiate<Message>()->header.stamp);
  }
  return stamps;
}

std::vector<ros::Time> within(const std::vector<ros::Time>& stamps, const ros::Time& from,
                              const ros::Time& to) {
  std::vector<ros::Time> inside;
  std::copy_if(stamps.begin(), stamps.end(), std::back_inserter(inside),
               [&](const ros::Time& stamp) { return stamp >= from && stamp <= to; });
  return inside;
}

double largestGap_s(const std::vector<ros::Time>& stamps) {
  double gap_s = 0.0;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    gap_s = std::max(gap_s, (stamps[i] - stamps[i - 1]).toSec());
  }
  return gap_s;
}

/// The robot with simulated devices. A slow drive at 10 Hz: a loaded machine keeps pace, and it outlasts the
/// test.
std::vector<std::string> robotLaunch(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {
      "roslaunch", "stereo_nav", "robot.launch", "simulated:=true",
      "settings:=rig.samples_per_pixel=2;timing.rate_hz=10;motion.max_speed_mps=0.1"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

class TwoMachines : public testing::Test {
 protected:
  /// Starts `command` on the robot, beside a recorder of what must not suffer there.
  void startRobot(const std::vector<std::string>& command) {
    robot_ = kRobot.start(folder_, command);
    ASSERT_TRUE(spinUntil([] { return ros::master::check(); })) << "no master on the robot";
    // By rosrun, which becomes the recorder: `rosbag` may be gone before the recorder it has started has
    // closed the bag.
    recorder_ = kRobot.start(
        folder_, {"rosrun", "rosbag", "record", "--quiet", "--output-name=" + bag_, "/odom", "/camera/sync"});
  }

  /// Cuts the link, joins it again, and waits until everything that `arrivals` listens to goes on.
  void cutTheLink(
      const Arrivals& arrivals, const std::function<void()>& meanwhile = [] {}) {
    ASSERT_TRUE(spinUntil([&] { return arrivals.allHave(20, ros::Time()); }))
        << "not everything arrives on the base:\n"
        << arrivals.counts();
    StallMeter stalls;
    const auto spinFor = [&stalls](double duration_s) {
      spinUntil([&] { return stalls.tick(); }, duration_s);
    };
    spinFor(2.0);
    cut_ = ros::Time::now();
    setLink(false);
    meanwhile();
    spinFor(kCut_s - (ros::Time::now() - cut_).toSec());
    link_up_ = ros::Time::now();
    setLink(true);
    // TCP waits at most as long as it was cut off before it tries again.
    const double cut_s = (link_up_ - cut_).toSec();
    EXPECT_TRUE(
        spinUntil([&] { return stalls.tick() || arrivals.allHave(10, link_up_); }, kResume_s + cut_s));
    stall_s_ = stalls.longest_s();
    std::cout << "after a cut of " << cut_s << " s (the longest stall of the machine: " << stall_s_
              << " s) the base goes on after\n"
              << arrivals.resumption(link_up_);
  }

  /// Stamps that the recorder on the robot kept: of the time around the cut, and of that before it.
  struct Recorded {
    std::vector<ros::Time> around, before;
  };
  template <class Message>
  Recorded onRobot(const std::string& topic) {
    if (recorder_) recorder_->stop();
    recorder_.reset();
    const auto stamps = recordedStamps<Message>(bag_, topic);
    const ros::Duration margin(1.0);
    return {within(stamps, cut_ - margin, link_up_ + margin), within(stamps, ros::Time(), cut_ - margin)};
  }

  /// Around the cut the cameras have run as they had before, at the rate that the machine has them keep.
  void expectCamerasAsBefore(const Recorded& pairs) const {
    ASSERT_GE(pairs.before.size(), 10u) << "the simulator itself did not run";
    const double rate_hz =
        static_cast<double>(pairs.before.size() - 1) / (pairs.before.back() - pairs.before.front()).toSec();
    const double window_s = (link_up_ - cut_).toSec() + 2.0;
    EXPECT_GE(static_cast<double>(pairs.around.size()), 0.6 * rate_hz * window_s)
        << "before: " << rate_hz << " Hz";
  }
  /// A gap of the size of the cut would be its doing; one of a stall of the whole machine is not.
  double largestGapAllowed_s() const { return 0.5 * kCut_s + stall_s_; }

  void TearDown() override {
    recorder_.reset();
    robot_.reset();
  }

  const Folder folder_;
  ros::Time cut_, link_up_;
  double stall_s_ = 0.0;

 private:
  const std::string bag_ = folder_ / "robot.bag";
  std::unique_ptr<NodeProcess> robot_, recorder_;
};

TEST_F(TwoMachines, OdometryOnTheRobotIsUndisturbedAndItsPicturesResumeOnTheBase) {
  ASSERT_NO_FATAL_FAILURE(startRobot(robotLaunch({})));
  Arrivals arrivals;
  arrivals.listen<nav_msgs::Odometry>("odom");
  arrivals.listen<nav_msgs::Path>("path");
  arrivals.listen<VoStatus>("vo/status");
  arrivals.listen<sensor_msgs::PointCloud2>("vo/features");
  arrivals.listen<sensor_msgs::Image>("vo/debug_image");
  arrivals.listen<sensor_msgs::Image>("vo/disparity_view");
  ASSERT_NO_FATAL_FAILURE(cutTheLink(arrivals));

  const auto pairs = onRobot<StereoSync>("/camera/sync");
  const auto poses = onRobot<nav_msgs::Odometry>("/odom");
  std::cout << "on the robot, around the cut: " << pairs.around.size() << " pairs, " << poses.around.size()
            << " odometry messages, largest gap " << largestGap_s(poses.around) << " s\n";
  ASSERT_NO_FATAL_FAILURE(expectCamerasAsBefore(pairs));
  // A busy machine's odometry leaves out frames; no more than before the cut.
  ASSERT_FALSE(poses.before.empty());
  const auto answered = within(pairs.before, poses.before.front(), poses.before.back()).size();
  const auto lost_before = answered - std::min(answered, poses.before.size());
  EXPECT_GE(poses.around.size() + 2 + lost_before, pairs.around.size()) << lost_before << " lost before";
  EXPECT_LT(largestGap_s(poses.around), largestGapAllowed_s());
}

TEST_F(TwoMachines, OdometryOnTheBaseGoesOnAfterACutAndTheCamerasAreUndisturbed) {
  ASSERT_NO_FATAL_FAILURE(startRobot(robotLaunch({"odometry:=false"})));
  const auto odometry = kBase.start(folder_, {"roslaunch", "stereo_nav", "odometry.launch"});
  Arrivals arrivals;
  arrivals.listen<nav_msgs::Odometry>("odom");
  arrivals.listen<VoStatus>("vo/status");
  VoStatus status;
  ros::NodeHandle handle;
  const boost::function<void(const VoStatusConstPtr&)> keep = [&](const VoStatusConstPtr& message) {
    status = *message;
  };
  const auto subscriber = handle.subscribe<VoStatus>("vo/status", 10, keep);
  ASSERT_NO_FATAL_FAILURE(cutTheLink(arrivals));
  const auto is_tracking = [&] {
    return status.header.stamp > link_up_ && status.state == VoStatus::TRACKING;
  };
  EXPECT_TRUE(spinUntil(is_tracking, kResume_s)) << status.reason;

  const auto pairs = onRobot<StereoSync>("/camera/sync");
  std::cout << "on the robot, around the cut: " << pairs.around.size() << " pairs, largest gap "
            << largestGap_s(pairs.around) << " s\n";
  ASSERT_NO_FATAL_FAILURE(expectCamerasAsBefore(pairs));
  EXPECT_LT(largestGap_s(pairs.around), largestGapAllowed_s());
}

TEST_F(TwoMachines, OdometryThatStartsAnewDuringTheCutIsFoundByTheBase) {
  ASSERT_NO_FATAL_FAILURE(startRobot(robotLaunch({"nodelet:=false"})));
  Arrivals arrivals;
  arrivals.listen<nav_msgs::Odometry>("odom");
  arrivals.listen<VoStatus>("vo/status");
  ASSERT_NO_FATAL_FAILURE(cutTheLink(arrivals, [this] {
    kRobot.start(folder_, {"rosnode", "kill", "/visual_odometry"})->join();
  }));
}

}  // namespace
}  // namespace stereo_nav::test
