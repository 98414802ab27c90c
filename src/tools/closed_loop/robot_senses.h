#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "navigation/navigator/grid_surroundings.h"
#include "navigation/navigator/navigator.h"
#include "navigation/obstacles/obstacle_map.h"
#include "odometry/method/watched_odometry.h"
#include "ros/stereo_processing.h"
#include "sim/driven_simulation.h"
#include "stereo_nav/estimation/base_odometry.h"

namespace stereo_nav::tools {

/// How the robot of a closed loop knows where it is and what stands around it.
struct SenseOptions {
  std::string odometry_config;  ///< of the visual odometry; empty: it knows the truth
  bool imu = true;              ///< the odometry gets the IMU
  double latency_s = 0.08;      ///< from an exposure to a pose and a local grid
  double grid_rate_hz = 10.0;   ///< of the local grid
  ros_io::DisparityParams disparity;
  navigation::ObstacleParams obstacles;
};

/// Cameras, IMU and bumpers of a simulated robot, and the nodes behind them without a graph: rectification,
/// disparity, visual odometry and local grid, all on the image pairs of the simulation. Deterministic.
class RobotSenses : public sim::DrivenSink {
 public:
  /// Throws ParameterError, InputError.
  RobotSenses(const sim::DrivenSimulation& simulation, const SenseOptions& options);

  /// Works on all pairs whose results are there by `now_s`.
  void process(double now_s);
  /// What is known now; nothing before the first pair. `surroundings` lives as long as this object.
  std::optional<navigator::Situation> situation(double now_s) const;
  /// What was seen around the robot, in odom; null before the first pair.
  std::shared_ptr<const grid::OccupancyGrid> localGrid() const;

  /// From base_link to the nearest place ahead whose disparity is measured, m.
  double nearestFloor_m() const;
  std::size_t frames() const { return frames_; }
  std::size_t framesLost() const { return frames_lost_; }
  /// Touched while it moved, each time by name.
  const std::vector<std::string>& collisions() const { return collisions_; }

  void takeTicks(const sim::SimulatedTicks& ticks, const sim::BaseState& truth) override;
  void takeImu(const ImuSample& sample) override;
  void takeScan(const laser::Scan& scan) override;
  void takeRange(std::size_t finder, double time_s, double range_m) override;
  void takeShot(sim::StereoShot shot) override;
  void takeContacts(double time_s, const std::vector<std::string>& names) override;

 private:
  void see(const sim::StereoShot& shot);
  estimation::BaseEstimate truth(const sim::BaseState& state) const;

  SenseOptions options_;
  const sim::DrivenSimulation& simulation_;
  Eigen::Isometry3d T_base_camera_;
  ros_io::StereoProcessing processing_;
  std::unique_ptr<odometry::WatchedOdometry> odometry_;  ///< none: the truth
  estimation::BaseOdometry base_;
  navigation::ObstacleMap obstacles_;
  std::deque<sim::StereoShot> shots_;
  std::optional<estimation::BaseEstimate> estimate_;
  double stamp_s_ = 0.0, grid_stamp_s_ = -1.0;
  bool lost_ = false;
  std::optional<navigator::GridSurroundings> surroundings_;
  std::size_t frames_ = 0, frames_lost_ = 0;
  std::vector<std::string> collisions_;
};

}  // namespace stereo_nav::tools
