#pragma once

#include <vector>

#include "navigation/obstacles/evidence_layer.h"
#include "navigation/obstacles/standing_edges.h"
#include "navigation/obstacles/stereo_columns.h"

namespace stereo_nav::navigation {

/// A beam of a laser or of a range finder, in its sensor's frame, in the plane of its x and y axes.
struct Beam {
  double direction_rad = 0.0;
  double range_m = 0.0;  ///< of what it meets, or the range up to which it met nothing
  bool hit = false;
  double half_width_rad = 0.0;
};

/// A local grid of obstacles around the robot, with fixed places in the frame `odom`. The stereo camera, the
/// laser and the range finders each have a layer of their own, since each sees other heights: none clears
/// what another has seen.
///
/// A cell is occupied if one of them says so, free if one saw it free and none occupied, and else unknown:
/// what lies nearer than the cameras can see, beside their view, and behind obstacles stays unknown. Memory
/// and time are bounded by the size of the grid and of the inputs.
class ObstacleMap {
 public:
  explicit ObstacleMap(const ObstacleParams& params);

  /// Keeps the window around the robot.
  void follow(const Eigen::Vector2d& robot_odom);
  /// One disparity image (CV_32FC1, px, at most 0 where unknown), with the images that it is of, or without.
  void addDisparity(double time_s, const cv::Mat& disparity, const DisparityCamera& camera,
                    const Eigen::Isometry3d& T_odom_base, const RectifiedPair& images = {});
  void addScan(double time_s, const std::vector<Beam>& beams, const Eigen::Isometry3d& T_odom_sensor);
  /// One reading of a range finder; it counts across the width of its beam.
  void addRange(double time_s, const Beam& beam, const Eigen::Isometry3d& T_odom_sensor);
  void clear();

  /// The grid as it is now, its origin in `odom`. Valid until the next call.
  const grid::OccupancyGrid& grid();
  const FloorPlane& floor() const { return columns_.floor(); }

 private:
  void addBeams(EvidenceLayer& layer, double time_s, const std::vector<Beam>& beams,
                const Eigen::Isometry3d& T_odom_sensor);
  /// Free from one place to the other, both in odom; the last cell is left out.
  void seeFreeAlong(EvidenceLayer& layer, const Eigen::Vector2d& from, const Eigen::Vector2d& to) const;

  ObstacleParams params_;
  StereoColumns columns_;
  StandingEdges edges_;
  EvidenceLayer stereo_, scan_, ranges_;
  grid::OccupancyGrid grid_;
  std::vector<Beam> one_beam_;
};

}  // namespace stereo_nav::navigation
