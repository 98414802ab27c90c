#include "navigation/obstacles/standing_edges.h"

#include <gtest/gtest.h>

#include "unit/navigation/obstacles/drawn_disparity.h"

namespace stereo_nav::navigation {
namespace {

constexpr double kBoard_m = 2.0, kBoardHeight_m = 0.16;

/// Grey level of a world whose lines all run across the view: floor and wall, and a white band that either
/// lies on the floor or stands on it.
double greyOf(bool stands, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  const double to_floor = planeAt(0.0, origin, direction);
  const double x = origin.x() + to_floor * direction.x();
  const double board_z = origin.z() + (kBoard_m - origin.x()) / direction.x() * direction.z();
  if (stands && board_z > 0.0 && board_z < kBoardHeight_m) return 190.0;
  if (!std::isfinite(to_floor) || x > 6.0) return 40.0;
  return !stands && x > kBoard_m && x < 2.4 ? 190.0 : 90.0;
}

/// What one camera of the robot sees at `x_m`, `right_m` beside the left one.
cv::Mat view(bool stands, const DisparityCamera& camera, double x_m, double right_m) {
  constexpr int kSub = 3;  // rows are smoothed as a lens does
  cv::Mat_<std::uint8_t> image(240, 320);
  const Eigen::Vector3d origin =
      camera.T_base_camera * Eigen::Vector3d(right_m, 0.0, 0.0) + Eigen::Vector3d(x_m, 0.0, 0.0);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      double sum = 0.0;
      for (int i = 0; i < kSub; ++i) {
        const double row = v + (i - 1.0) / kSub;
        const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1.0);
        sum += greyOf(stands, origin, camera.T_base_camera.linear() * ray);
      }
      image(v, u) = static_cast<std::uint8_t>(sum / kSub);
    }
  }
  return image;
}

/// What is found at the last of these places of the robot.
std::vector<StandingEdge> edgesOf(bool stands, const std::vector<double>& places_m) {
  const DisparityCamera camera = drawnCamera();
  StandingEdges edges{ObstacleParams()};
  std::vector<StandingEdge> found;
  for (const double x_m : places_m) {
    const Eigen::Isometry3d T_odom_camera = Eigen::Translation3d(x_m, 0.0, 0.0) * camera.T_base_camera;
    found = edges.look({view(stands, camera, x_m, 0.0), view(stands, camera, x_m, camera.baseline_m)},
                       cv::Mat_<float>(240, 320, -1.0F), camera, floorOf(camera), T_odom_camera);
  }
  return found;
}

TEST(StandingEdges, OfAPlainBoardAcrossTheViewAreSeenFromTwoPlaces) {
  const auto edges = edgesOf(true, {0.0, 0.15, 0.3});
  EXPECT_GT(edges.size(), 30U);
  const double depth_m = kBoard_m - 0.3 - drawnCamera().T_base_camera.translation().x();
  for (const StandingEdge& edge : edges) EXPECT_NEAR(edge.z_m, depth_m, 0.03) << "column " << edge.u;
}

TEST(StandingEdges, AreNotSeenByARobotThatStands) {
  EXPECT_TRUE(edgesOf(true, {0.0, 0.0, 0.0}).empty());
}

TEST(StandingEdges, AreNotMarksOnTheFloor) {
  EXPECT_TRUE(edgesOf(false, {0.0, 0.15, 0.3}).empty());
}

}  // namespace
}  // namespace stereo_nav::navigation
