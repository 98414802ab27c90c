// What the local grid sees of simulated scenes, held against the scene itself.
//
//   obstacle_bench_test [--no-edges] CALIBRATION_FOLDER DISPARITY_YAML SCENARIO.yaml...
//
// The robot drives as the scenario says; each second of it is looked at with all frames so far. Outline: for
// each direction of the view the first surface higher than 8 cm up to 3 m away, not nearer than the largest
// disparity. It is in the grid if an occupied cell's centre is within 10 cm. False cells: occupied ones in
// the view with nothing higher than 2 cm within 10 cm, now and at any time of the last 2 s, of all cells
// known there: what walks away has that long to fade.
#include <fmt/format.h>

#include <boost/make_shared.hpp>
#include <iostream>
#include <optional>

#include "core/processor_time.h"
#include "core/statistics.h"
#include "navigation/obstacles/obstacle_map.h"
#include "ros/simulated_messages.h"
#include "ros/stereo_processing.h"
#include "sim/simulation.h"
#include "stereo_nav/core/parameters.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::navigation {
namespace {

constexpr double kNear_m = 0.1;

struct Score {
  std::size_t outline = 0, in_grid = 0, known = 0, false_cells = 0;
  std::vector<double> times_ms;
};

class Course {
 public:
  Course(const std::string& scenario_file, const std::string& calibration,
         const ros_io::DisparityParams& disparity, bool edges)
      : edges_(edges),
        simulation_(sim::loadScenario(scenario_file, {"timing.rate_hz=10"}),
                    sim::loadStereoCalibration(calibration), 1),
        scene_(simulation_.scenario().scene),
        messages_(simulation_, ros::Time(100.0)),
        disparity_(disparity),
        map_(ObstacleParams()) {}

  Score run() {
    for (std::size_t i = 0; i < simulation_.pairs().size(); ++i) {
      look(i);
      if (i % 10 == 9) judge(simulation_.imageTime(sim::Side::kLeft, i));
    }
    return score_;
  }

 private:
  void look(std::size_t pair) {
    const ros_io::PairMessages messages = messages_.pair(pair);
    if (!processing_) processing_.emplace(messages.left_info, messages.right_info, disparity_);
    const auto raw = [](const sensor_msgs::Image& image) {
      return ros_io::toMono8(boost::make_shared<sensor_msgs::Image>(image))
          .clone();  // it shares the message's data
    };
    const RectifiedPair images{processing_->rectifyLeft(raw(messages.left)),
                               processing_->rectifyRight(raw(messages.right))};
    const cv::Mat map = processing_->disparity(images.left, images.right);
    const vision::StereoCalibration& calibration = processing_->calibration();
    camera_ = {calibration.fx, calibration.fy,         calibration.cx,
               calibration.cy, calibration.baseline_m, simulation_.scenario().rig.T_base_camera()};
    const double time_s = simulation_.imageTime(sim::Side::kLeft, pair);
    const Eigen::Isometry3d T_odom_base = simulation_.trajectory().pose(time_s);
    const double start_ms = processorTime_ms();
    map_.follow(T_odom_base.translation().head<2>());
    map_.addDisparity(time_s, map, camera_, T_odom_base, edges_ ? images : RectifiedPair());
    map_.grid();
    score_.times_ms.push_back(processorTime_ms() - start_ms);
  }

  void judge(double time_s) {
    const Eigen::Isometry3d T_odom_camera = simulation_.trajectory().pose(time_s) * camera_.T_base_camera;
    const grid::OccupancyGrid& grid = map_.grid();
    const double nearest_m = camera_.fx * camera_.baseline_m / disparity_.disparity_range;
    for (double u = firstColumn(); u < lastColumn(); u += 4.0) {
      Eigen::Vector3d direction =
          T_odom_camera.linear() * Eigen::Vector3d((u - camera_.cx) / camera_.fx, 0.0, 1.0);
      direction.z() = 0.0;
      Eigen::Vector3d origin = T_odom_camera.translation();
      origin.z() = 0.08;
      const double z_m = scene_.castRay(origin, direction, time_s);
      if (z_m < nearest_m || z_m * direction.norm() > 3.0) continue;
      ++score_.outline;
      if (occupiedNear(grid, (origin + z_m * direction).head<2>())) ++score_.in_grid;
    }
    countFalse(grid, T_odom_camera, time_s);
  }

  /// Columns in which the block matcher can find something.
  double firstColumn() const { return disparity_.disparity_range + 0.5 * disparity_.correlation_window_size; }
  double lastColumn() const {
    return processing_->calibration().width - 0.5 * disparity_.correlation_window_size;
  }

  static bool occupiedNear(const grid::OccupancyGrid& grid, const Eigen::Vector2d& place) {
    const grid::Cell middle = grid.geometry.cellAt(place);
    const int reach = static_cast<int>(kNear_m / grid.geometry.resolution_m) + 1;
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const grid::Cell cell{middle.x + dx, middle.y + dy};
        if (grid.geometry.contains(cell) && grid.at(cell) == grid::kOccupied &&
            (grid.geometry.centreOf(cell) - place).norm() <= kNear_m)
          return true;
      }
    }
    return false;
  }

  void countFalse(const grid::OccupancyGrid& grid, const Eigen::Isometry3d& T_odom_camera, double time_s) {
    for (int y = 0; y < grid.geometry.height; ++y) {
      for (int x = 0; x < grid.geometry.width; ++x) {
        if (grid.at({x, y}) == grid::kUnknown) continue;
        const Eigen::Vector2d place = grid.geometry.centreOf({x, y});
        const Eigen::Vector3d seen = T_odom_camera.inverse() * Eigen::Vector3d(place.x(), place.y(), 0.0);
        if (seen.z() < 0.3 || seen.z() > 3.0 || std::fabs(seen.x() / seen.z()) > camera_.cx / camera_.fx)
          continue;
        ++score_.known;
        if (grid.at({x, y}) == grid::kOccupied && !stoodNear(place, time_s)) ++score_.false_cells;
      }
    }
  }

  bool stoodNear(const Eigen::Vector2d& place, double time_s) const {
    for (double ago_s = 0.0; ago_s <= 2.0; ago_s += 0.2)
      if (standsNear(place, std::max(0.0, time_s - ago_s))) return true;
    return false;
  }

  bool standsNear(const Eigen::Vector2d& place, double time_s) const {
    for (double dy = -kNear_m; dy <= kNear_m; dy += 0.025)
      for (double dx = -kNear_m; dx <= kNear_m; dx += 0.025) {
        if (std::hypot(dx, dy) > kNear_m) continue;
        const double down_m = scene_.castRay({place.x() + dx, place.y() + dy, 1.5}, {0.0, 0.0, -1.0}, time_s);
        if (down_m < 1.48) return true;
      }
    return false;
  }

  bool edges_;
  sim::Simulation simulation_;
  sim::Scene scene_;
  ros_io::SimulatedMessages messages_;
  ros_io::DisparityParams disparity_;
  std::optional<ros_io::StereoProcessing> processing_;
  DisparityCamera camera_;
  ObstacleMap map_;
  Score score_;
};

}  // namespace
}  // namespace stereo_nav::navigation

int main(int argc, char** argv) {
  using namespace stereo_nav;
  const bool edges = argc < 2 || std::string(argv[1]) != "--no-edges";
  if (!edges) --argc, ++argv;
  if (argc < 4) {
    std::cerr
        << "usage: obstacle_bench_test [--no-edges] CALIBRATION_FOLDER DISPARITY_YAML SCENARIO.yaml...\n";
    return 2;
  }
  cv::setNumThreads(1);
  ros_io::DisparityParams disparity;
  readParameters(loadYamlFile(argv[2]), argv[2], disparity);
  for (int i = 3; i < argc; ++i) {
    const auto score = navigation::Course(argv[i], argv[1], disparity, edges).run();
    const auto share = [](std::size_t part, std::size_t of) {
      return 100.0 * static_cast<double>(part) / static_cast<double>(of);
    };
    fmt::print(
        "{}: outline in the grid {:.2f} % of {}, false cells {:.3f} % of {}, processor time a frame {:.2f} ms (95 %: {:.2f})\n",
        argv[i], share(score.in_grid, score.outline), score.outline, share(score.false_cells, score.known),
        score.known, quantile(score.times_ms, 0.5), quantile(score.times_ms, 0.95));
  }
  return 0;
}
