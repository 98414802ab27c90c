#include "navigation/obstacles/obstacle_map.h"

#include <cmath>

#include "grid/ray_cast.h"

namespace stereo_nav::navigation {
namespace {

int cellsOfSide(const ObstacleParams& params) {
  return static_cast<int>(std::lround(params.size_m / params.resolution_m));
}

EvidenceLayer layerOf(const ObstacleParams& params) {
  return {cellsOfSide(params), params.memory_s,
          static_cast<int>(std::lround(params.near_m / params.resolution_m)), params.near_memory_s};
}

}  // namespace

ObstacleMap::ObstacleMap(const ObstacleParams& params)
    : params_(params),
      columns_(params),
      edges_(params),
      stereo_(layerOf(params)),
      scan_(layerOf(params)),
      ranges_(layerOf(params)) {
  grid::GridGeometry geometry;
  geometry.width = geometry.height = cellsOfSide(params);
  geometry.resolution_m = params.resolution_m;
  geometry.origin_x_m = geometry.origin_y_m = -0.5 * geometry.width * geometry.resolution_m;
  grid_ = grid::OccupancyGrid(geometry);
}

void ObstacleMap::clear() {
  for (EvidenceLayer* layer : {&stereo_, &scan_, &ranges_}) layer->clearAll();
}

void ObstacleMap::follow(const Eigen::Vector2d& robot_odom) {
  grid::GridGeometry& geometry = grid_.geometry;
  const Eigen::Vector2d off = geometry.inCells(robot_odom) - Eigen::Vector2d::Constant(0.5 * geometry.width);
  if (off.cwiseAbs().maxCoeff() < 2.0) return;
  const grid::Cell by{static_cast<int>(std::lround(off.x())), static_cast<int>(std::lround(off.y()))};
  for (EvidenceLayer* layer : {&stereo_, &scan_, &ranges_}) layer->shift(by);
  geometry.origin_x_m += by.x * geometry.resolution_m;
  geometry.origin_y_m += by.y * geometry.resolution_m;
}

void ObstacleMap::addDisparity(double time_s, const cv::Mat& disparity, const DisparityCamera& camera,
                               const Eigen::Isometry3d& T_odom_base, const RectifiedPair& images) {
  const std::vector<ColumnView>& views = columns_.look(disparity, camera);
  const Eigen::Isometry3d T_odom_camera = T_odom_base * camera.T_base_camera;
  // Where a surface at a depth meets the floor: its foot is seen in the row where the floor has its
  // disparity.
  const auto place = [&](double u, double z_m) {
    const double v = columns_.floor().row(u, camera.fx * camera.baseline_m / z_m);
    const Eigen::Vector3d foot(z_m * (u - camera.cx) / camera.fx, z_m * (v - camera.cy) / camera.fy, z_m);
    return Eigen::Vector2d((T_odom_camera * foot).head<2>());
  };
  stereo_.beginLook(time_s);
  for (const ColumnView& view : views) {
    if (view.clear_to_m > view.clear_from_m)
      seeFreeAlong(stereo_, place(view.u, view.clear_from_m), place(view.u, view.clear_to_m));
    for (const auto* occupied : {&view.obstacles_m, &view.holes_m})
      for (const double z_m : *occupied) stereo_.seeOccupied(grid_.geometry.cellAt(place(view.u, z_m)));
  }
  if (!images.left.empty())
    for (const StandingEdge& edge : edges_.look(images, disparity, camera, columns_.floor(), T_odom_camera))
      stereo_.seeOccupied(grid_.geometry.cellAt(place(edge.u, edge.z_m)));
  stereo_.endLook();
}

void ObstacleMap::addScan(double time_s, const std::vector<Beam>& beams,
                          const Eigen::Isometry3d& T_odom_sensor) {
  addBeams(scan_, time_s, beams, T_odom_sensor);
}

void ObstacleMap::addRange(double time_s, const Beam& beam, const Eigen::Isometry3d& T_odom_sensor) {
  // As many rays as cells lie side by side at its end.
  const double width_m = 2.0 * beam.half_width_rad * beam.range_m;
  const int rays = 1 + static_cast<int>(width_m / params_.resolution_m);
  one_beam_.clear();
  for (int i = 0; i < rays; ++i) {
    Beam ray = beam;
    if (rays > 1) ray.direction_rad += beam.half_width_rad * (2.0 * i / (rays - 1) - 1.0);
    one_beam_.push_back(ray);
  }
  addBeams(ranges_, time_s, one_beam_, T_odom_sensor);
}

void ObstacleMap::addBeams(EvidenceLayer& layer, double time_s, const std::vector<Beam>& beams,
                           const Eigen::Isometry3d& T_odom_sensor) {
  const Eigen::Vector2d origin = T_odom_sensor.translation().head<2>();
  layer.beginLook(time_s);
  for (const Beam& beam : beams) {
    const Eigen::Vector3d end =
        T_odom_sensor * Eigen::Vector3d(beam.range_m * std::cos(beam.direction_rad),
                                        beam.range_m * std::sin(beam.direction_rad), 0.0);
    if (beam.hit) layer.seeOccupied(grid_.geometry.cellAt(end.head<2>()));
    seeFreeAlong(layer, origin, end.head<2>());
  }
  layer.endLook();
}

void ObstacleMap::seeFreeAlong(EvidenceLayer& layer, const Eigen::Vector2d& from,
                               const Eigen::Vector2d& to) const {
  const grid::Cell last = grid_.geometry.cellAt(to);
  bool was_inside = false;
  grid::traverse(grid_.geometry.inCells(from), grid_.geometry.inCells(to), [&](grid::Cell cell, double) {
    if (cell == last) return false;
    if (!grid_.geometry.contains(cell)) return !was_inside;
    was_inside = true;
    layer.seeFree(cell);
    return true;
  });
}

const grid::OccupancyGrid& ObstacleMap::grid() {
  using State = EvidenceLayer::State;
  for (std::size_t i = 0; i < grid_.cells.size(); ++i) {
    const State states[] = {stereo_.state(i), scan_.state(i), ranges_.state(i)};
    std::int8_t value = grid::kUnknown;
    for (const State state : states) {
      if (state == State::kOccupied) value = grid::kOccupied;
      if (state == State::kFree && value == grid::kUnknown) value = grid::kFree;
    }
    grid_.cells[i] = value;
  }
  return grid_;
}

}  // namespace stereo_nav::navigation
