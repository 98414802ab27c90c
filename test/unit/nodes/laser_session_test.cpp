// When a scan is processed, and what happens when stamps go back.
#include "nodes/laser_odometry/laser_session.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/odometry/laser/walled_world.h"

namespace stereo_nav::nodes {
namespace {

using odometry::planarPose;
using odometry::TurningLaser;
using odometry::WalledWorld;

/// From the middle of the room, every 50 s again.
Eigen::Vector3d ahead(double time_s) {
  return {0.3 * std::fmod(time_s, 50.0), 0.0, 0.0};
}

class LaserSessionTest : public testing::Test {
 protected:
  LaserSessionTest() { session.setMounting(Eigen::Isometry3d::Identity()); }

  void addWheelsUpTo(double time_s) {
    for (; fed_s < time_s; fed_s += 0.02) session.addWheels(fed_s, planarPose(ahead(fed_s)));
  }

  odometry::LaserScan scan(double time_s) { return laser.scan(time_s); }

  TurningLaser laser{WalledWorld::room(7.0, 5.0), ahead};
  LaserSession session{odometry::LaserParams(), 0.3};
  double fed_s = -0.1;
};

TEST_F(LaserSessionTest, aScanWaitsForTheWheelsThatAreHeardAndForNothingElse) {
  session.addScan(scan(0.0), 7, 10.0);
  EXPECT_EQ(session.take(10.0).readings.size(), 1u) << "nothing was heard that it could wait for";
  addWheelsUpTo(0.15);
  session.addScan(scan(0.1), 7, 10.1);
  EXPECT_TRUE(session.take(10.2).readings.empty()) << "the wheels do not cover its last beam";
  addWheelsUpTo(0.25);
  const LaserSessionOutput output = session.take(10.2);
  ASSERT_EQ(output.readings.size(), 1u);
  EXPECT_TRUE(output.readings[0].result.wheels);
  EXPECT_EQ(output.readings[0].stamp_ns, 7);
  session.addScan(scan(0.2), 7, 10.3);
  EXPECT_TRUE(session.take(10.5).readings.empty());
  EXPECT_EQ(session.take(10.61).readings.size(), 1u) << "longer than prior_wait_s";
  EXPECT_EQ(session.counts().without_prior, 1u);
  session.addScan(scan(2.0), 7, 12.0);
  EXPECT_EQ(session.take(12.0).readings.size(), 1u) << "the wheels are silent since a second";
}

TEST_F(LaserSessionTest, aScanWaitsForTheMounting) {
  session.setMounting(std::nullopt);
  for (int i = 0; i < 25; ++i) session.addScan(scan(0.1 * i), 7, 0.1 * i);
  EXPECT_TRUE(session.take(3.0).readings.empty());
  EXPECT_EQ(session.counts().dropped, 5u);
  session.setMounting(Eigen::Isometry3d::Identity());
  EXPECT_EQ(session.take(3.0).readings.size(), 20u);
}

TEST_F(LaserSessionTest, aClockThatIsSetBackMovesNoRobot) {
  LaserSessionOutput output;
  for (int i = 0; i <= 20; ++i) {
    session.addScan(scan(100.0 + 0.1 * i), 7, 0.1 * i);
    output = session.take(0.1 * i);
  }
  const Eigen::Isometry2d before = output.readings.back().result.T_odom_base;
  EXPECT_NEAR(before.translation().x(), 0.6, 0.03);
  session.addScan(scan(101.9), 7, 2.0);
  EXPECT_TRUE(session.take(2.0).readings.empty());
  EXPECT_EQ(session.counts().dropped, 1u) << "late";
  session.addScan(scan(1.0), 7, 2.1);
  output = session.take(2.1);
  ASSERT_EQ(output.readings.size(), 1u);
  ASSERT_EQ(output.announcements.size(), 1u);
  EXPECT_NE(output.announcements[0].find("went back by 101.0 s"), std::string::npos)
      << output.announcements[0];
  EXPECT_LT((output.readings[0].result.T_odom_base.translation() - before.translation()).norm(), 1e-6);
  session.addScan(scan(1.1), 7, 2.2);
  EXPECT_EQ(session.take(2.2).readings.size(), 1u);
}

TEST_F(LaserSessionTest, wheelsThatComeBeforeTheFirstScanOfABagThatStartsAgainAreKept) {
  fed_s = 100.0;
  for (int i = 0; i <= 20; ++i) {
    addWheelsUpTo(100.15 + 0.1 * i);
    session.addScan(scan(100.0 + 0.1 * i), 7, 0.1 * i);
    ASSERT_EQ(session.take(0.1 * i).readings.size(), 1u);
  }
  fed_s = 0.9;
  for (int i = 0; i <= 20; ++i) {
    addWheelsUpTo(1.15 + 0.1 * i);
    session.addScan(scan(1.0 + 0.1 * i), 7, 3.0 + 0.1 * i);
    const LaserSessionOutput output = session.take(3.0 + 0.1 * i);
    ASSERT_EQ(output.readings.size(), 1u) << "nothing is waited for, scan " << i;
    EXPECT_EQ(output.announcements.size(), i == 0 ? 1u : 0u);
    EXPECT_TRUE(output.readings[0].result.wheels) << "scan " << i;
  }
  EXPECT_EQ(session.counts().without_prior, 0u);
}

TEST_F(LaserSessionTest, wheelsOfTheOldClockTellNothingOfTheNewOne) {
  fed_s = 100.0;
  for (int i = 0; i <= 20; ++i) {
    addWheelsUpTo(100.15 + 0.1 * i);
    session.addScan(scan(100.0 + 0.1 * i), 7, 0.1 * i);
    session.take(0.1 * i);
  }
  // Back by two seconds, into what the wheels had covered before.
  for (int i = 0; i <= 5; ++i) {
    session.addScan(scan(100.3 + 0.1 * i), 7, 3.0 + 0.1 * i);
    const LaserSessionOutput output = session.take(3.0 + 0.1 * i);
    ASSERT_EQ(output.readings.size(), 1u);
    EXPECT_FALSE(output.readings[0].result.wheels) << "scan " << i;
  }
}

TEST_F(LaserSessionTest, aScanThatCannotBeUsedIsSaid) {
  Eigen::Isometry3d tilted = Eigen::Isometry3d::Identity();
  tilted.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY()));
  session.setMounting(tilted);
  session.addScan(scan(0.0), 7, 0.0);
  const LaserSessionOutput output = session.take(0.0);
  EXPECT_TRUE(output.readings.empty());
  EXPECT_NE(output.error.find("mounted with a tilt of 40 deg"), std::string::npos) << output.error;
}

}  // namespace
}  // namespace stereo_nav::nodes
