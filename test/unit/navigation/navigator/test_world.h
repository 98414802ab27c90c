#pragma once

#include <functional>
#include <vector>

#include "navigation/navigator/navigator.h"

namespace stereo_nav::navigator {

/// An axis-parallel box on the floor.
struct Box {
  double min_x, min_y, max_x, max_y;

  bool contains(const Eigen::Vector2d& p, double margin_m = 0.0) const {
    return p.x() > min_x - margin_m && p.x() < max_x + margin_m && p.y() > min_y - margin_m &&
           p.y() < max_y + margin_m;
  }
};

/// A room of 10 x 10 m about the origin with boxes, as seen without error. Map and world are one; odom may
/// differ from them.
class TestWorld : public Surroundings {
 public:
  Place at(const Eigen::Vector2d& p_odom) const override;
  bool touches(const Eigen::Isometry2d& T_world_base, double half_m) const;

  std::vector<Box> boxes;
  Eigen::Isometry2d T_world_odom = Eigen::Isometry2d::Identity();
  std::function<bool(const Eigen::Vector2d&)> seen = [](const Eigen::Vector2d&) { return true; };
};

/// Shortest ways over cells of 10 cm that lie 40 cm from all boxes; of the boxes from `surprise` on it knows
/// those only that were within 2 m of the base.
class TestPlanner : public RoutePlanner {
 public:
  explicit TestPlanner(TestWorld& world) : world_(world) {}

  Route plan(const Eigen::Isometry2d& T_map_base, const Goal& goal) override;
  bool isFree(const std::vector<Eigen::Vector2d>& points_map) override;
  void clear() override { ++cleared; }

  /// Tells where the base is, which sees boxes nearby.
  void look(const Eigen::Vector2d& p_map) { p_map_ = p_map; }

  std::size_t surprise = 1000;
  bool blind = false;  ///< knows of no box at all
  int plans = 0, cleared = 0;

 private:
  bool blocked(const Eigen::Vector2d& p, double margin_m) const;

  TestWorld& world_;
  Eigen::Vector2d p_map_ = Eigen::Vector2d::Zero();
};

/// Base, world, planner and navigator in a closed loop of 50 Hz.
struct ClosedLoop {
  explicit ClosedLoop(const NavigatorParams& params_in = {});

  /// One period; the situation is as it should be, then `change` is applied to it.
  void step(const std::function<void(Situation&)>& change = [](Situation&) {});
  /// Until the navigator has ended or `most_s` are over.
  void run(
      double most_s, const std::function<void(Situation&)>& change = [](Situation&) {});

  NavigatorParams params;
  TestWorld world;
  TestPlanner planner;
  Navigator navigator;
  control::DriveState state;  ///< in the world
  Twist command = Twist::Zero();
  double time_s = 0.0;
  bool touched_in_motion = false, wheels_blocked = false;

 private:
  control::CommandHistory under_way_;
};

}  // namespace stereo_nav::navigator
