// The simulated arena live, started by simulator.test: topics, odometry, mark_waypoint by service and by key,
// depth_at on live topics.
#include <geometry_msgs/PointStamped.h>
#include <gtest/gtest.h>
#include <sensor_msgs/Imu.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <future>
#include <sstream>

#include "core/rig_file.h"
#include "rostest/graph_probe.h"
#include "sim/simulation.h"
#include "stereo_nav/StereoSync.h"
#include "support/command.h"

namespace stereo_nav::test {
namespace {

constexpr double kDrive_s = 150.0;     // the drive takes 30 s; the rest is for a loaded machine
constexpr double kTolerance_m = 0.35;  // 3 % of the course
const cv::Point kPixel(266, 90);       // on a box beside the course, as seen from the start

struct Mark {
  double time_s, x_m, y_m, true_x_m, true_y_m;
};

std::vector<Mark> readMarks(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "time_s,x_m,y_m,true_x_m,true_y_m");
  std::vector<Mark> marks;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    Mark mark{};
    words >> mark.time_s >> mark.x_m >> mark.y_m >> mark.true_x_m >> mark.true_y_m;
    EXPECT_FALSE(words.fail()) << line;
    marks.push_back(mark);
  }
  return marks;
}

std::string contentOf(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A mark_waypoint of its own that is told by key presses.
class KeyMarker {
 public:
  KeyMarker(const std::string& output, const std::string& truth)
      : log_(output + ".log"),
        keys_(popen(("exec " MARK_WAYPOINT " __name:=mark_by_key _output:=" + output + " _truth:=" + truth +
                     " > " + log_ + " 2>&1")
                        .c_str(),
                    "w")) {}
  void press() {
    std::fputs("\n", keys_);
    std::fflush(keys_);
  }
  /// What it printed, once it has ended by itself.
  std::string finish() {
    EXPECT_EQ(pclose(keys_), 0);
    return contentOf(log_);
  }

 private:
  std::string log_;
  FILE* keys_;
};

/// Distance along the view to what is at kPixel of the rectified left image, from the start.
double trueDepth() {
  const sim::Scenario scenario = sim::loadScenario(STEREO_NAV_SOURCE_DIR "/config/scenarios/arena.yaml");
  const Eigen::Isometry3d T_base_camera =
      RigFile::load(STEREO_NAV_SOURCE_DIR "/config/rigs/thesis.yaml").mounting().camera.T_base_optical();
  const auto& P = sim::loadStereoCalibration(STEREO_NAV_SOURCE_DIR "/config/thesis").left.P;
  const Eigen::Vector3d ray((kPixel.x - P(0, 2)) / P(0, 0), (kPixel.y - P(1, 2)) / P(1, 1), 1.0);
  return sim::Scene(scenario.scene).castRay(T_base_camera.translation(), T_base_camera.linear() * ray, 0.0);
}

/// The distances that `depth_at --each` printed for stamps before `end_s`.
std::vector<double> depthsBefore(double end_s, const std::string& output) {
  std::vector<double> depths;
  std::istringstream lines(output);
  double stamp_s = 0.0, depth_m = 0.0;
  for (std::string line; std::getline(lines, line);) {
    if (std::sscanf(line.c_str(), "%lf %lf", &stamp_s, &depth_m) == 2 && stamp_s < end_s) {
      depths.push_back(depth_m);
    }
  }
  return depths;
}

class Simulator : public testing::Test {
 protected:
  std::string parameter(const char* name) const { return ros::NodeHandle("~").param<std::string>(name, ""); }

  /// Every mark has the way-point's true position, in order, and is where the robot was at its time.
  void expectGoodMarks(const std::vector<Mark>& marks) {
    ASSERT_EQ(marks.size(), 12u);
    for (std::size_t i = 0; i < marks.size(); ++i) {
      EXPECT_EQ(marks[i].true_x_m, waypoints_[i].point.x) << i;
      EXPECT_EQ(marks[i].true_y_m, waypoints_[i].point.y) << i;
      const auto truth =
          std::find_if(probe_.ground_truth.begin(), probe_.ground_truth.end(), [&](const auto& message) {
            return std::abs(message.header.stamp.toSec() - marks[i].time_s) < 1e-3;
          });
      ASSERT_NE(truth, probe_.ground_truth.end()) << i;
      EXPECT_LT(
          std::hypot(truth->pose.pose.position.x - marks[i].x_m, truth->pose.pose.position.y - marks[i].y_m),
          kTolerance_m)
          << i;
    }
  }

  ros::NodeHandle handle_;
  GraphProbe probe_;
  std::vector<geometry_msgs::PointStamped> waypoints_;
};

TEST_F(Simulator, DrivesTheGraphWhileWaypointsAreMarkedAndADistanceIsMeasured) {
  std::size_t imu = 0, synced = 0;
  const ros::Subscriber imu_subscriber =
      handle_.subscribe<sensor_msgs::Imu>("imu/data", 1000, [&](const sensor_msgs::ImuConstPtr&) { ++imu; });
  const ros::Subscriber sync_subscriber =
      handle_.subscribe<StereoSync>("camera/sync", 100, [&](const StereoSyncConstPtr&) { ++synced; });
  const ros::Subscriber waypoint_subscriber = handle_.subscribe<geometry_msgs::PointStamped>(
      "ground_truth/waypoint", 100,
      [&](const geometry_msgs::PointStampedConstPtr& passed) { waypoints_.push_back(*passed); });
  // The robot stands for its first two seconds only: be there in time.
  auto depth = std::async(std::launch::async, [] {
    return runCommand(DEPTH_AT " --live --pixel 266 90 --window 9 --frames 20 --each");
  });
  auto service = handle_.serviceClient<std_srvs::Trigger>("mark_waypoint/mark");
  ASSERT_TRUE(service.waitForExistence(ros::Duration(60.0)));
  std_srvs::Trigger early;
  ASSERT_TRUE(service.call(early));
  EXPECT_FALSE(early.response.success) << "nothing to mark yet";
  EXPECT_NE(early.response.message.find("nothing came on /odom"), std::string::npos)
      << early.response.message;

  KeyMarker keys(parameter("by_key"), parameter("truth"));
  for (std::size_t marked = 0; marked < 12; ++marked) {
    ASSERT_TRUE(spinUntil([&] { return waypoints_.size() > marked; }, kDrive_s)) << marked;
    ASSERT_TRUE(spinUntil([&] { return !probe_.odometry.empty(); }, kDrive_s));
    keys.press();
    std_srvs::Trigger mark;
    ASSERT_TRUE(service.call(mark));
    EXPECT_TRUE(mark.response.success) << mark.response.message;
  }
  ASSERT_TRUE(spinUntil(
      [&] {
        return probe_.ground_truth.back().header.stamp - probe_.odometry.back().header.stamp <
               ros::Duration(0.25);
      },
      kDrive_s));

  const std::string said = keys.finish();
  EXPECT_NE(said.find("way-point 12 at"), std::string::npos) << said;
  EXPECT_NE(said.find("RMSE"), std::string::npos) << said;
  for (const char* marked_by : {"by_service", "by_key"}) {
    SCOPED_TRACE(marked_by);
    const std::vector<Mark> marks = readMarks(parameter(marked_by));
    ASSERT_FALSE(marks.empty());
    spinUntil([&] { return probe_.ground_truth.back().header.stamp.toSec() >= marks.back().time_s - 1e-3; });
    expectGoodMarks(marks);
  }
  EXPECT_GT(imu, 2000u);
  EXPECT_GE(synced, probe_.odometry.size());

  const CommandResult measured = depth.get();
  EXPECT_EQ(measured.status, 0) << measured.output;
  EXPECT_NE(measured.output.find("pixel (266, 90): mean "), std::string::npos) << measured.output;
  const auto moving = std::find_if(probe_.ground_truth.begin(), probe_.ground_truth.end(),
                                   [](const auto& truth) { return truth.pose.pose.position.x > 0.02; });
  ASSERT_NE(moving, probe_.ground_truth.end());
  const std::vector<double> depths = depthsBefore(moving->header.stamp.toSec(), measured.output);
  EXPECT_GE(depths.size(), 3u) << measured.output;
  for (const double depth_m : depths) EXPECT_NEAR(depth_m, trueDepth(), 0.03 * trueDepth());
}

}  // namespace
}  // namespace stereo_nav::test
