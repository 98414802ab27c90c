// imu_bridge nodes on emulated modules, started by imu_bridge.test.
#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/Quaternion.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/String.h>
#include <std_srvs/Trigger.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "rostest/graph_probe.h"
#include "sensors/imu/module_angles.h"
#include "stereo_nav/sensors/imu/calibration.h"
#include "support/node_process.h"

namespace stereo_nav::test {
namespace {

/// Where imu_bridge.test has the names of the ports.
std::string portsFolder() {
  return ros::param::param<std::string>("~ports", "");
}

/// One bridge's topics.
class Bridge {
 public:
  explicit Bridge(const std::string& name) : handle_(name) {
    data_ = handle_.subscribe<sensor_msgs::Imu>(
        "imu/data", 10000, [this](const sensor_msgs::Imu::ConstPtr& m) { data.push_back(*m); });
    raw_ = handle_.subscribe<sensor_msgs::Imu>(
        "imu/data_raw", 10000, [this](const sensor_msgs::Imu::ConstPtr& m) { data_raw.push_back(*m); });
    quaternion_ = handle_.subscribe<geometry_msgs::Quaternion>(
        "imu_quat", 10000,
        [this](const geometry_msgs::Quaternion::ConstPtr& m) { quaternions.push_back(*m); });
    chatter_ = handle_.subscribe<std_msgs::String>(
        "chatter", 100, [this](const std_msgs::String::ConstPtr& m) { texts.push_back(m->data); });
    const std::string own = "/" + name + "/imu_bridge: imu";
    diagnostics_ = handle_.subscribe<diagnostic_msgs::DiagnosticArray>(
        "/diagnostics", 1000, [this, own](const diagnostic_msgs::DiagnosticArray::ConstPtr& m) {
          for (const auto& status : m->status) {
            if ("/" + status.name == own || status.name == own) diagnostics.push_back(status);
          }
        });
  }

  bool saidInDiagnostics(const std::string& part) const {
    for (const auto& status : diagnostics) {
      if (status.message.find(part) != std::string::npos) return true;
    }
    return false;
  }

  double lastValue(const std::string& key) const {
    for (const auto& value : diagnostics.back().values) {
      if (value.key == key) return std::stod(value.value);
    }
    return std::nan("");
  }

  std_srvs::Trigger::Response call(const std::string& service) {
    std_srvs::Trigger trigger;
    EXPECT_TRUE(ros::service::waitForService(handle_.resolveName(service), ros::Duration(kLongWait_s)));
    EXPECT_TRUE(handle_.serviceClient<std_srvs::Trigger>(service).call(trigger));
    return trigger.response;
  }

  std::vector<sensor_msgs::Imu> data, data_raw;
  std::vector<geometry_msgs::Quaternion> quaternions;
  std::vector<std::string> texts;
  std::vector<diagnostic_msgs::DiagnosticStatus> diagnostics;

 private:
  ros::NodeHandle handle_;
  ros::Subscriber data_, raw_, quaternion_, chatter_, diagnostics_;
};

Eigen::Quaterniond orientationOf(const sensor_msgs::Imu& message) {
  const auto& q = message.orientation;
  return {q.w, q.x, q.y, q.z};
}

double stepDegrees(const sensor_msgs::Imu& before, const sensor_msgs::Imu& now) {
  return imu::heading(orientationOf(now) * orientationOf(before).conjugate()) / kDegree;
}

/// By the headings.
double meanTurn_dps(const std::vector<sensor_msgs::Imu>& data) {
  double turned_deg = 0.0;
  for (std::size_t i = 1; i < data.size(); ++i) turned_deg += stepDegrees(data[i - 1], data[i]);
  return turned_deg / (data.back().header.stamp - data.front().header.stamp).toSec();
}

/// By the rates.
double meanVelocity_dps(const std::vector<sensor_msgs::Imu>& data) {
  double sum = 0.0;
  for (const auto& message : data) sum += message.angular_velocity.z;
  return sum / static_cast<double>(data.size()) / kDegree;
}

TEST(ImuBridge, PublishesTheWorkedExampleInEveryForm) {
  Bridge bridge("clean");
  ASSERT_TRUE(spinUntil([&] { return bridge.data.size() > 300 && bridge.quaternions.size() > 300; }));
  for (const auto& q : bridge.quaternions) {
    EXPECT_NEAR(q.x, -0.0645, 1e-4);
    EXPECT_NEAR(q.y, -0.0729, 1e-4);
    EXPECT_NEAR(q.z, -0.2613, 1e-4);
    EXPECT_NEAR(q.w, 0.9604, 1e-4);
  }
  const sensor_msgs::Imu& message = bridge.data.back();
  EXPECT_EQ(message.header.frame_id, "imu_link");
  EXPECT_NEAR(message.orientation.z, -0.2613, 1e-4);
  EXPECT_GT(message.orientation_covariance[8], 0.0);
  EXPECT_NEAR(message.angular_velocity.z, 0.0, 1e-6);
  EXPECT_GT(message.angular_velocity_covariance[0], 0.0);
  EXPECT_EQ(message.linear_acceleration_covariance[0], -1.0) << "the module does not measure it";
  for (std::size_t i = 1; i < bridge.data.size(); ++i) {
    ASSERT_GT(bridge.data[i].header.stamp, bridge.data[i - 1].header.stamp);
  }
  ASSERT_TRUE(spinUntil([&] { return !bridge.texts.empty(); }));
  EXPECT_NE(bridge.texts.back().find("yaw: 30"), std::string::npos) << bridge.texts.back();
  ASSERT_TRUE(spinUntil([&] { return bridge.saidInDiagnostics("streaming"); }));
  // Of a second in which the machine did not stall.
  EXPECT_TRUE(spinUntil([&] { return std::abs(bridge.lastValue("rate (Hz)") - 100.0) < 5.0; }))
      << bridge.lastValue("rate (Hz)");
  EXPECT_EQ(bridge.lastValue("bad frames"), 0.0);
}

TEST(ImuBridge, ResetsTheYawAndRefusesToCalibrateTheAngleModule) {
  Bridge bridge("clean");
  ASSERT_TRUE(spinUntil([&] { return !bridge.data.empty(); }));
  EXPECT_TRUE(bridge.call("imu/reset_yaw").success);
  ASSERT_TRUE(spinUntil([&] { return std::abs(imu::heading(orientationOf(bridge.data.back()))) < 1e-6; }));
  const auto refusal = bridge.call("imu/calibrate_gyro");
  EXPECT_FALSE(refusal.success);
  EXPECT_NE(refusal.message.find("angles"), std::string::npos);
}

TEST(ImuBridge, TurnsTheRightWayAcrossTheWrapOnADamagedLine) {
  constexpr double kRate_dps = -20.0;  // the module's yaw grows clockwise
  Bridge bridge("turning");
  ASSERT_TRUE(spinUntil([&] { return bridge.data.size() > 1000; }));
  for (std::size_t i = 1; i < bridge.data.size(); ++i) {
    const sensor_msgs::Imu &before = bridge.data[i - 1], &now = bridge.data[i];
    // Where the machine stalls, frames between the two may be lost.
    const double due_deg = kRate_dps * (now.header.stamp - before.header.stamp).toSec();
    EXPECT_LT(std::abs(stepDegrees(before, now)), 5.0 + std::abs(due_deg));
  }
  // A stall shifts a stamp; the longer the drive, the less it matters.
  EXPECT_TRUE(spinUntil([&] { return std::abs(meanTurn_dps(bridge.data) - kRate_dps) < 1.0; }))
      << meanTurn_dps(bridge.data);
  EXPECT_TRUE(spinUntil([&] { return std::abs(meanVelocity_dps(bridge.data) - kRate_dps) < 1.0; }))
      << meanVelocity_dps(bridge.data);
  ASSERT_TRUE(spinUntil([&] { return !bridge.diagnostics.empty(); }));
  EXPECT_GT(bridge.lastValue("bad frames"), 0.0);
}

TEST(ImuBridge, FindsAModuleAgainUnderAnotherIndex) {
  Bridge bridge("replugged");
  ASSERT_TRUE(
      spinUntil([&] { return !bridge.diagnostics.empty() && bridge.lastValue("connections") >= 2.0; }));
  bridge.data.clear();
  EXPECT_TRUE(spinUntil([&] { return bridge.data.size() > 100; }));
}

TEST(ImuBridge, SaysThatAModuleIsSilentAndGoesOnWithIt) {
  Bridge bridge("pausing");
  ASSERT_TRUE(spinUntil([&] { return bridge.saidInDiagnostics("pausing does not exist"); }));
  const NodeProcess module({IMU_EMULATOR, "--wait-for-reader", "--pause-at", "2", "--pause-for", "4",
                            "--link", portsFolder() + "/pausing"});
  EXPECT_TRUE(spinUntil([&] { return bridge.saidInDiagnostics("no bytes for "); }));
  bridge.data.clear();
  bridge.diagnostics.clear();
  EXPECT_TRUE(spinUntil([&] { return bridge.data.size() > 100 && bridge.saidInDiagnostics("streaming"); }));
  EXPECT_EQ(bridge.lastValue("connections"), 1.0);
  EXPECT_EQ(bridge.diagnostics.back().level, diagnostic_msgs::DiagnosticStatus::OK);
}

TEST(ImuBridge, WrongBaudRateIsNamed) {
  Bridge bridge("wrong_baud");
  EXPECT_TRUE(spinUntil([&] { return bridge.saidInDiagnostics("check the baud rate (57600 here)"); }));
  EXPECT_TRUE(bridge.data.empty());
}

TEST(ImuBridge, AMissingPortIsNamed) {
  Bridge bridge("missing");
  EXPECT_TRUE(spinUntil([&] { return bridge.saidInDiagnostics("nothing_here does not exist"); }));
}

TEST(ImuBridge, CalibratesARawModuleAndStoresIt) {
  Bridge bridge("raw");
  ASSERT_TRUE(spinUntil([&] { return bridge.data.size() > 100 && bridge.data_raw.size() > 100; }));
  const sensor_msgs::Imu& raw = bridge.data_raw.back();
  EXPECT_EQ(raw.orientation_covariance[0], -1.0);
  EXPECT_NEAR(raw.angular_velocity.z, 0.03, 0.01);
  EXPECT_NEAR(raw.linear_acceleration.z, 9.80665, 1e-3);
  EXPECT_GT(bridge.data.back().orientation_covariance[0], 0.0);

  const auto answer = bridge.call("imu/calibrate_gyro");
  ASSERT_TRUE(answer.success) << answer.message;
  const auto stored = imu::loadCalibration(portsFolder() + "/calibration.yaml");
  EXPECT_LT((stored.gyroscope_bias.value - Eigen::Vector3d(0.02, -0.01, 0.03)).norm(), 5e-4);

  // What was measured before the answer may still be on its way.
  const ros::Time calibrated = ros::Time::now();
  bridge.data.clear();
  ASSERT_TRUE(spinUntil([&] {
    auto& data = bridge.data;
    data.erase(std::remove_if(data.begin(), data.end(),
                              [&](const auto& message) { return message.header.stamp < calibrated; }),
               data.end());
    return data.size() > 400;
  }));
  double mean = 0.0;
  for (const auto& message : bridge.data)
    mean += message.angular_velocity.z / static_cast<double>(bridge.data.size());
  EXPECT_NEAR(mean, 0.0, 1e-3);
  const double turned =
      imu::heading(orientationOf(bridge.data.back())) - imu::heading(orientationOf(bridge.data.front()));
  EXPECT_NEAR(turned, 0.0, 0.01) << "0.06 without the calibration";
}

TEST(ImuBridge, CalibratesAPhoneThroughLossAndOvertaking) {
  Bridge bridge("phone");
  ASSERT_TRUE(spinUntil([&] { return bridge.data.size() > 300 && bridge.data_raw.size() > 300; }));
  EXPECT_NEAR(bridge.data_raw.back().linear_acceleration.z, 9.80665, 1e-3);
  EXPECT_NEAR(bridge.data_raw.back().angular_velocity.z, 0.03, 0.01);
  for (std::size_t i = 1; i < bridge.data.size(); ++i) {
    EXPECT_GT(bridge.data[i].header.stamp, bridge.data[i - 1].header.stamp);
  }
  const auto answer = bridge.call("imu/calibrate_gyro");
  ASSERT_TRUE(answer.success) << answer.message;
  const auto stored = imu::loadCalibration(portsFolder() + "/phone.yaml");
  EXPECT_LT((stored.gyroscope_bias.value - Eigen::Vector3d(0.02, -0.01, 0.03)).norm(), 5e-4);
  EXPECT_TRUE(
      spinUntil([&] { return !bridge.diagnostics.empty() && bridge.lastValue("late frames") > 0.0; }));
  EXPECT_GT(bridge.lastValue("lost frames"), 0.0);
}

}  // namespace
}  // namespace stereo_nav::test
