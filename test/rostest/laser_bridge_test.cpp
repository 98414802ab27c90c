// laser_bridge nodes on emulated scanners, started by laser_bridge.test.
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "rostest/diagnostics_probe.h"
#include "sensors/serial/steady_clock.h"
#include "support/ros_wait.h"

namespace stereo_nav::test {
namespace {

/// One bridge's scans.
class ScanProbe {
 public:
  explicit ScanProbe(const std::string& name) : handle_(name) {
    subscriber_ = handle_.subscribe<sensor_msgs::LaserScan>(
        "scan", 1000, [this](const sensor_msgs::LaserScan::ConstPtr& scan) { scans.push_back(*scan); });
  }
  std::vector<sensor_msgs::LaserScan> scans;

 private:
  ros::NodeHandle handle_;
  ros::Subscriber subscriber_;
};

/// What the emulator wrote about its samples, with times of ROS.
struct LoggedSample {
  double time_s, heading_deg;
};

std::vector<LoggedSample> readLog(const std::string& path) {
  const double offset_s = ros::Time::now().toSec() - serial::steadyNow_s();
  std::vector<LoggedSample> samples;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    double time_s = 0.0, heading_deg = 0.0;
    if (std::sscanf(line.c_str(), "%lf,%lf", &time_s, &heading_deg) == 2) {
      samples.push_back({time_s + offset_s, heading_deg});
    }
  }
  return samples;
}

/// The time at which the head pointed at a heading, from the samples around it that are nearest to `near_s`;
/// NaN where there are none.
double timeOf(const std::vector<LoggedSample>& samples, double heading_deg, double near_s) {
  const auto after =
      std::lower_bound(samples.begin(), samples.end(), near_s,
                       [](const LoggedSample& sample, double time_s) { return sample.time_s < time_s; });
  if (after == samples.begin() || after == samples.end()) return std::nan("");
  const auto before = after - 1;
  const double step_deg = std::remainder(after->heading_deg - before->heading_deg, 360.0);
  const double ahead_deg = std::remainder(heading_deg - before->heading_deg, 360.0);
  return before->time_s + ahead_deg / step_deg * (after->time_s - before->time_s);
}

double medianOf(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/// What a beam mostly measures: in one scan or another no sample may come nearest to it.
template <class Scans>
double rangeOf(const Scans& scans, std::size_t beam) {
  std::vector<double> ranges_m;
  for (const sensor_msgs::LaserScan& scan : scans) {
    if (std::isfinite(scan.ranges[beam])) ranges_m.push_back(scan.ranges[beam]);
  }
  EXPECT_GE(ranges_m.size(), scans.size() / 2) << "beam " << beam;
  return medianOf(ranges_m);
}

TEST(LaserBridge, ScansTheRoomAndStampsEachBeam) {
  ScanProbe probe("clean");
  ASSERT_TRUE(spinUntil([&] { return probe.scans.size() >= 60; }));
  const sensor_msgs::LaserScan& scan = probe.scans.back();
  ASSERT_EQ(scan.ranges.size(), 360U);
  EXPECT_EQ(scan.header.frame_id, "laser_link");
  EXPECT_NEAR(scan.angle_increment, -2.0 * M_PI / 360.0, 1e-6);
  EXPECT_NEAR(scan.angle_min + 359.0F * scan.angle_increment, scan.angle_max, 1e-5);
  EXPECT_NEAR(rangeOf(probe.scans, 0), 3.0, 0.02);
  EXPECT_NEAR(rangeOf(probe.scans, 90), 2.0, 0.02);
  EXPECT_NEAR(rangeOf(probe.scans, 45), 2.0 / std::sin(M_PI / 4.0), 0.06);

  const auto log = readLog(ros::param::param<std::string>("~log", ""));
  ASSERT_GT(log.size(), 10000U);
  std::vector<double> errors_s;
  for (std::size_t s = 20; s + 2 < probe.scans.size(); ++s) {
    const sensor_msgs::LaserScan& judged = probe.scans[s];
    for (std::size_t i = 0; i < judged.ranges.size(); i += 15) {
      const double time_s = judged.header.stamp.toSec() + static_cast<double>(i) * judged.time_increment;
      const double true_s = timeOf(log, static_cast<double>(i), time_s);
      if (!std::isnan(true_s)) errors_s.push_back(std::abs(time_s - true_s));
    }
  }
  ASSERT_GT(errors_s.size(), 500U);
  std::cout << "median error of a beam's stamp: " << 1e3 * medianOf(errors_s) << " ms\n";
  EXPECT_LT(medianOf(errors_s), 1e-3);
}

TEST(LaserBridge, KeepsScanningOnADamagedLineAndCounts) {
  ScanProbe probe("damaged");
  DiagnosticsProbe diagnostics;
  ASSERT_TRUE(spinUntil([&] { return probe.scans.size() >= 20; }));
  std::size_t right = 0, present = 0;
  for (const auto& scan : probe.scans) {
    for (const std::size_t beam : {0U, 90U, 180U, 270U}) {
      if (!std::isfinite(scan.ranges[beam])) continue;
      ++present;
      right += static_cast<std::size_t>(std::abs(scan.ranges[beam] - (beam % 180 == 0 ? 3.0 : 2.0)) < 0.02);
    }
  }
  EXPECT_GT(present, 20U);
  EXPECT_GT(static_cast<double>(right), 0.95 * static_cast<double>(present));
  EXPECT_TRUE(spinUntil([&] { return diagnostics.says("damaged/laser_bridge: laser", "dropped samples"); }))
      << diagnostics.names();
  EXPECT_TRUE(spinUntil([&] {
    return diagnostics.says("damaged/laser_bridge: laser", "samples are damaged");
  })) << diagnostics.textOf("damaged/laser_bridge: laser");
}

TEST(LaserBridge, FindsAScannerThatComesBackUnderAnotherName) {
  ScanProbe probe("replugged");
  DiagnosticsProbe diagnostics;
  const std::string name = "replugged/laser_bridge: laser";
  EXPECT_TRUE(spinUntil([&] { return diagnostics.says(name, "connections: 2"); }))
      << diagnostics.textOf(name);
  probe.scans.clear();
  EXPECT_TRUE(spinUntil([&] { return probe.scans.size() >= 3; }));
  EXPECT_TRUE(diagnostics.says(name, "firmware 1.29"));
}

TEST(LaserBridge, SaysThatNothingAnswersAtAWrongBaudRate) {
  DiagnosticsProbe diagnostics;
  EXPECT_TRUE(spinUntil([&] {
    return diagnostics.says("wrong_baud/laser_bridge: laser", "does not answer");
  })) << diagnostics.textOf("wrong_baud/laser_bridge: laser");
}

}  // namespace
}  // namespace stereo_nav::test
