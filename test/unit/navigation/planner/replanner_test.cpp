#include "navigation/planner/replanner.h"

#include <gtest/gtest.h>

#include "unit/navigation/planner/planner_scene.h"

namespace stereo_nav::navigation {
namespace {

/// A wall with two doors of the same size at either side of the straight way.
class ReplannerAtTwoDoors : public testing::Test {
 protected:
  ReplannerAtTwoDoors() : map_(freeMap(8.0, 8.0, 0.05)), planner_(contestRobot()), replanner_(planner_) {
    setBox(map_, 0.0, 4.0, 8.0, 4.1);
    setDoor(kLeft, true);
    setDoor(kRight, true);
    planner_.setMap(map_);
    replanner_.setGoal({4.0, 7.0});
  }

  static constexpr double kLeft = 1.5, kRight = 5.5;  // 1 m wide each; the right one is a little nearer

  void setDoor(double x, bool open) {
    const cv::Rect changed = setBox(map_, x, 4.0, x + 1.0, 4.1, open ? grid::kFree : grid::kOccupied);
    if (replanner_.plan().found()) planner_.update(map_, changed);
  }
  /// Whether the way leads through the right door.
  bool leadsRight() const {
    for (std::size_t i = 1; i < replanner_.plan().poses.size(); ++i) {
      const Eigen::Vector2d a = replanner_.plan().poses[i - 1].position_m,
                            b = replanner_.plan().poses[i].position_m;
      if (a.y() <= 4.05 && b.y() >= 4.05)
        return (a + (b - a) * (4.05 - a.y()) / std::max(1e-9, b.y() - a.y())).x() > 4.0;
    }
    ADD_FAILURE() << "the way does not lead through the wall";
    return false;
  }

  grid::OccupancyGrid map_;
  PathPlanner planner_;
  Replanner replanner_;
};

using Change = Replanner::Change;

TEST_F(ReplannerAtTwoDoors, KeepsItsWayWhileItIsGood) {
  EXPECT_EQ(replanner_.update({{4.0, 1.0}, 0.0}).change, Change::kFirst);
  EXPECT_TRUE(leadsRight());
  for (double x = 4.0; x > 3.6; x -= 0.05) {  // the other door becomes a little nearer
    EXPECT_EQ(replanner_.update({{x, 1.0}, 0.0}).change, Change::kKept);
    EXPECT_TRUE(leadsRight());
    EXPECT_NEAR(replanner_.plan().poses.front().position_m.x(), x, 1e-9) << "it begins at the robot";
  }
}

TEST_F(ReplannerAtTwoDoors, PlansAnewWhenItsWayIsBlockedAndNotBackForLittle) {
  replanner_.update({{4.0, 1.0}, 0.0});
  setDoor(kRight, false);
  const auto blocked = replanner_.update({{4.0, 1.0}, 0.0});
  EXPECT_EQ(blocked.change, Change::kBlocked);
  EXPECT_NE(blocked.text.find("an obstacle is in the way"), std::string::npos);
  EXPECT_FALSE(leadsRight());
  setDoor(kRight, true);
  EXPECT_EQ(replanner_.update({{4.0, 1.0}, 0.0}).change, Change::kKept);
  EXPECT_FALSE(leadsRight());
}

TEST_F(ReplannerAtTwoDoors, TakesAWayThatIsClearlyBetter) {
  replanner_.update({{4.0, 1.0}, 0.0});
  EXPECT_EQ(replanner_.update({{0.8, 3.3}, 0.0}).change, Change::kBetter) << "somebody carried the robot";
  EXPECT_FALSE(leadsRight());
}

TEST_F(ReplannerAtTwoDoors, DoesNotGoToAndFroHoweverTheDoorsFlicker) {
  replanner_.update({{5.9, 3.2}, 0.0});
  int changes = 0;
  for (int i = 0; i < 40; ++i) {
    // The nearer door closes for a moment, again and again: only what is forced happens, and it is not undone
    // each time.
    setDoor(kRight, i % 2 == 1);
    const auto decision = replanner_.update({{5.9, 3.2}, 0.0});
    if (decision.change == Change::kBetter) ++changes;
  }
  EXPECT_LE(changes, 3);
}

TEST_F(ReplannerAtTwoDoors, SaysWhenThereIsNoWayAnyMore) {
  replanner_.update({{4.0, 1.0}, 0.0});
  setDoor(kRight, false);
  setDoor(kLeft, false);
  const auto decision = replanner_.update({{4.0, 1.0}, 0.0});
  EXPECT_EQ(decision.change, Change::kNone);
  EXPECT_NE(decision.text.find("no way"), std::string::npos) << decision.text;
}

}  // namespace
}  // namespace stereo_nav::navigation
