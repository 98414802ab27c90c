#include "navigation/planner/robot_space.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "grid/rectangles.h"

namespace stereo_nav::navigation {
namespace {

constexpr double kMoveAngle_rad = kPi / 4.0;

const Eigen::Vector2d kCentre(0.5, 0.5);

Eigen::Vector2d stepOf(int move) {
  const grid::Cell step = kMoveSteps[static_cast<std::size_t>(move)];
  return Eigen::Vector2d(step.x, step.y);
}

grid::Polygon scaled(grid::Polygon polygon, double factor) {
  for (auto& corner : polygon) corner *= factor;
  return polygon;
}

}  // namespace

RobotSpace::RobotSpace(const grid::Footprint& footprint_m, HeadingRule rule,
                       const grid::ClearanceParams& clearance, grid::UnknownSpace unknown)
    : footprint_m_(footprint_m), rule_(rule), clearance_(clearance), unknown_(unknown) {}

void RobotSpace::setMap(const grid::OccupancyGrid& map, double kept_heading_rad) {
  geometry_ = map.geometry;
  kept_heading_rad_ = wrapRadians(kept_heading_rad - geometry_.origin_yaw_rad);
  footprint_.emplace(scaled(footprint_m_.corners(), 1.0 / geometry_.resolution_m));
  cost_.emplace(clearance_, geometry_.resolution_m, MoveGrid::kCostUnits);
  obstacles_ = grid::obstacleMask(map, unknown_);
  rows_.assign(obstacles_, outside());
  obstacle_distance_.emplace(static_cast<int>(std::ceil(footprint_->circumscribedRadius())) +
                             cost_->reach_cells());
  obstacle_distance_->assign(obstacles_);
  makeShapes();
  makeLayers();
  moves_ = MoveGrid();
  moves_.width = geometry_.width;
  moves_.height = geometry_.height;
  moves_.moves.assign(geometry_.size(), 0);
  if (!turn_masks_.empty()) moves_.turns.assign(geometry_.size(), 0);
  for (std::size_t k = 0; k < kMoves; ++k) moves_.costs[k] = layers_[layer_of_move_[k]].costs.ptr();
  updateMoves({0, 0, geometry_.width, geometry_.height});
}

void RobotSpace::makeShapes() {
  move_masks_.clear();
  turn_masks_.clear();
  for (int k = 0; k < kMoves; ++k) {
    const double heading_rad = headingAlong(stepOf(k));
    move_masks_.emplace_back(grid::cellsOf(footprint_->sweptBy(kCentre, kCentre + stepOf(k), heading_rad)),
                             outside());
    move_masks_.back().assign(obstacles_);
    if (rule_ == HeadingRule::kKept) continue;
    turn_masks_.emplace_back(
        grid::cellsOf(footprint_->turning(kCentre, heading_rad, heading_rad + kMoveAngle_rad)), outside());
    turn_masks_.back().assign(obstacles_);
  }
}

void RobotSpace::makeLayers() {
  layers_.clear();
  for (int k = 0; k < kMoves; ++k) {
    const std::vector<grid::CellSpan> shape = grid::cellsOf(footprint_->at(kCentre, headingAlong(stepOf(k))));
    std::size_t& layer = layer_of_move_[static_cast<std::size_t>(k)];
    for (layer = 0; layer < layers_.size() && !(layers_[layer].mask.shape() == shape);) ++layer;
    if (layer < layers_.size()) continue;  // a symmetric outline looks the same at several headings
    layers_.push_back({grid::CollisionMask(shape, outside()), grid::DistanceField(cost_->reach_cells()), {}});
    Layer& made = layers_.back();
    made.mask.assign(obstacles_);
    made.distance.assign(made.mask.cells());
    made.costs.create(obstacles_.size());
    cost_->apply(made.distance.cells(), {0, 0, geometry_.width, geometry_.height}, made.costs);
  }
}

void RobotSpace::update(const grid::OccupancyGrid& map, const cv::Rect& changed) {
  const cv::Rect part = changed & cv::Rect({0, 0}, obstacles_.size());
  if (part.empty()) return;
  grid::updateObstacleMask(map, unknown_, part, obstacles_);
  rows_.update(obstacles_, part);
  obstacle_distance_->update(obstacles_, part);
  cv::Rect moved;
  for (auto& mask : move_masks_) moved |= mask.update(obstacles_, part);
  for (auto& mask : turn_masks_) moved |= mask.update(obstacles_, part);
  for (auto& layer : layers_) {
    const cv::Rect collides = layer.mask.update(obstacles_, part);
    layer.distance.update(layer.mask.cells(), collides);
    cost_->apply(layer.distance.cells(), grid::grown(collides, cost_->reach_cells(), obstacles_.size()),
                 layer.costs);
  }
  updateMoves(moved);
}

void RobotSpace::updateMoves(const cv::Rect& part) {
  const cv::Rect whole({0, 0}, obstacles_.size());
  for (int y = part.y; y < part.br().y; ++y) {
    const std::size_t row = geometry_.index({0, y});
    std::fill_n(&moves_.moves[row + static_cast<std::size_t>(part.x)], part.width, std::uint8_t{0});
    for (std::size_t k = 0; k < kMoves; ++k) {
      const int to_y = y + kMoveSteps[k].y;
      if (to_y < 0 || to_y >= whole.height) continue;
      const std::uint8_t* collides = move_masks_[k].cells()[y];
      const int begin = std::max(part.x, -kMoveSteps[k].x),
                end = std::min(part.br().x, whole.width - kMoveSteps[k].x);
      for (int x = begin; x < end; ++x)
        moves_.moves[row + static_cast<std::size_t>(x)] |= static_cast<std::uint8_t>((1 - collides[x]) << k);
    }
    if (turn_masks_.empty()) continue;
    for (int x = part.x; x < part.br().x; ++x) {
      unsigned turns = 0;
      for (std::size_t k = 0; k < kMoves; ++k) turns |= (1U - turn_masks_[k].cells()(y, x)) << k;
      moves_.turns[row + static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(turns);
    }
  }
}

double RobotSpace::headingAlong(const Eigen::Vector2d& way) const {
  return rule_ == HeadingRule::kKept ? kept_heading_rad_ : std::atan2(way.y(), way.x());
}

bool RobotSpace::fits(const Eigen::Vector2d& position, double heading_rad) const {
  return !rows_.anyIn(grid::cellsOf(footprint_->at(position, heading_rad)));
}

bool RobotSpace::fitsAlong(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  return !rows_.anyIn(grid::cellsOf(footprint_->sweptBy(from, to, headingAlong(to - from))));
}

bool RobotSpace::fitsTurning(const Eigen::Vector2d& position, double from_rad, double to_rad) const {
  return !rows_.anyIn(grid::cellsOf(footprint_->turning(position, from_rad, to_rad)));
}

bool RobotSpace::fitsSomehow(grid::Cell cell) const {
  return std::any_of(layers_.begin(), layers_.end(),
                     [&](const Layer& layer) { return layer.mask.cells()(cell.y, cell.x) == 0; });
}

const RobotSpace::Layer& RobotSpace::layerAlong(const Eigen::Vector2d& way) const {
  const long k = std::lround(std::atan2(way.y(), way.x()) / kMoveAngle_rad);
  return layers_[layer_of_move_[static_cast<std::size_t>((k + kMoves) % kMoves)]];
}

double RobotSpace::costAlong(const Eigen::Vector2d& from, const Eigen::Vector2d& to) const {
  const Eigen::Vector2d way = to - from;
  const double length = way.norm();
  const int samples = std::max(1, static_cast<int>(std::ceil(length)));
  const Layer& layer = layerAlong(way);
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const Eigen::Vector2d at = from + way * ((i + 0.5) / samples);
    const grid::Cell cell = grid::cellHolding(at);
    if (geometry_.contains(cell)) sum += layer.costs(cell.y, cell.x);
  }
  return length * (1.0 + sum / samples / MoveGrid::kCostUnits);
}

double RobotSpace::clearance(const Eigen::Vector2d& position, double heading_rad) const {
  const grid::Polygon outline = footprint_->at(position, heading_rad);
  double least = obstacle_distance_->cells()(0, 0) + 1e6;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d side = outline[(i + 1) % outline.size()] - outline[i];
    const int samples = static_cast<int>(std::ceil(2.0 * side.norm()));
    for (int s = 0; s < samples; ++s) {
      const Eigen::Vector2d at = outline[i] + side * (static_cast<double>(s) / samples);
      const grid::Cell cell = grid::cellHolding(at);
      if (geometry_.contains(cell)) least = std::min<double>(least, obstacleDistance(cell) - 0.5);
    }
  }
  return std::max(0.0, least);
}

}  // namespace stereo_nav::navigation
