#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "grid/clearance_cost.h"
#include "grid/collision_mask.h"
#include "grid/distance_field.h"
#include "grid/footprint.h"
#include "grid/obstacle_rows.h"
#include "grid/occupancy_grid.h"
#include "navigation/planner/move_grid.h"

namespace stereo_nav::navigation {

/// Which way the robot faces on its path.
enum class HeadingRule {
  kTravel,  ///< where it drives to: differential and Ackermann drives
  kKept,    ///< always the same: swerve, mecanum and omni drives
};

/// A map as the robot meets it: where its outline fits, from which cell to which it can move, and what that
/// costs. Everything here is in cells and in the axes of the grid; a heading is counterclockwise from the
/// grid's x axis.
class RobotSpace {
 public:
  RobotSpace(const grid::Footprint& footprint_m, HeadingRule rule, const grid::ClearanceParams& clearance,
             grid::UnknownSpace unknown);

  /// Takes a map. `kept_heading_rad`: in the frame of the map, used by HeadingRule::kKept.
  void setMap(const grid::OccupancyGrid& map, double kept_heading_rad);
  /// Follows a change of the same map within `changed`, as if setMap() had been called; computes only what
  /// the change can reach.
  void update(const grid::OccupancyGrid& map, const cv::Rect& changed);

  const grid::GridGeometry& geometry() const { return geometry_; }
  HeadingRule rule() const { return rule_; }
  /// The heading that is kept, in the axes of the grid.
  double keptHeading() const { return kept_heading_rad_; }
  const MoveGrid& moves() const { return moves_; }

  /// The heading on a way in this direction.
  double headingAlong(const Eigen::Vector2d& way) const;
  /// Exactly, at any place: whether the robot touches no obstacle there, on a straight way, or while it
  /// turns.
  bool fits(const Eigen::Vector2d& position, double heading_rad) const;
  bool fitsAlong(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  bool fitsTurning(const Eigen::Vector2d& position, double from_rad, double to_rad) const;
  /// Whether it fits at the centre of a cell with one of the headings that it may have.
  bool fitsSomehow(grid::Cell cell) const;

  /// The cells at whose centre the robot touches an obstacle with the heading of a way in this direction;
  /// CV_8UC1, 1 where it does.
  const cv::Mat_<std::uint8_t>& collisionsAlong(const Eigen::Vector2d& way) const {
    return layerAlong(way).mask.cells();
  }

  /// Length of a straight way plus what its clearance costs, in cells.
  double costAlong(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;
  /// Distance of a cell's centre from the nearest obstacle's centre, in cells, up to a little more than the
  /// outline's farthest corner.
  float obstacleDistance(grid::Cell cell) const { return obstacle_distance_->cells()(cell.y, cell.x); }
  /// Clearance between the outline and the nearest obstacle cell, in cells, up to about the same; wrong by
  /// less than half a cell.
  double clearance(const Eigen::Vector2d& position, double heading_rad) const;

 private:
  /// The outline at one heading at the centres of all cells, and what the clearance there costs.
  struct Layer {
    grid::CollisionMask mask;
    grid::DistanceField distance;
    cv::Mat_<std::uint8_t> costs;
  };

  void makeShapes();
  void makeLayers();
  void updateMoves(const cv::Rect& part);
  const Layer& layerAlong(const Eigen::Vector2d& way) const;
  bool outside() const { return unknown_ == grid::UnknownSpace::kAsObstacle; }

  grid::Footprint footprint_m_;
  HeadingRule rule_;
  grid::ClearanceParams clearance_;
  grid::UnknownSpace unknown_;

  grid::GridGeometry geometry_;
  double kept_heading_rad_ = 0.0;
  std::optional<grid::Footprint> footprint_;  ///< in cells
  std::optional<grid::ClearanceCost> cost_;
  cv::Mat_<std::uint8_t> obstacles_;
  grid::ObstacleRows rows_;
  std::optional<grid::DistanceField> obstacle_distance_;
  std::vector<Layer> layers_;
  std::array<std::size_t, kMoves> layer_of_move_{};
  std::vector<grid::CollisionMask> move_masks_,
      turn_masks_;  ///< of each move; turn_masks_ is empty where the heading is kept
  MoveGrid moves_;
};

}  // namespace stereo_nav::navigation
