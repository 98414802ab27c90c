#pragma once

#include <deque>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "navigation/obstacles/floor_plane.h"
#include "navigation/obstacles/obstacle_params.h"

namespace stereo_nav::navigation {

/// The rectified images of a pair, CV_8UC1, both as large as the disparity image; empty: there are none.
struct RectifiedPair {
  cv::Mat left, right;
};

/// An edge that stands above the floor: its column, and its distance along the optical axis.
struct StandingEdge {
  double u = 0.0;
  double z_m = 0.0;
};

/// Finds edges that a disparity image lacks, such as those of a plain board that runs across the view. Two
/// cameras side by side measure no distance there, but one that has moved forward does. Each edge of the left
/// image is compared at a row of distances with the right image and with an earlier left one, whose pose the
/// odometry knows (plane sweep; Collins 1996). It stands if all distances at which it looks the same are
/// above the floor and next to each other: marks on the floor and repeated patterns do not pass. Its foot, an
/// edge on the floor below it, tells the distance best, since the floor is known.
///
/// An error of 0.05 degrees in pitch between the two poses moves edges by 0.4 px (fx 460). Memory is bounded
/// by ten images.
class StandingEdges {
 public:
  explicit StandingEdges(const ObstacleParams& params) : params_(params) {}

  /// `disparity` is that of the pair (CV_32FC1, px, at most 0 where unknown): where it shows floor or
  /// obstacle, no edge is looked for. The result is valid until the next call.
  const std::vector<StandingEdge>& look(const RectifiedPair& pair, const cv::Mat& disparity,
                                        const DisparityCamera& camera, const FloorPlane& floor,
                                        const Eigen::Isometry3d& T_odom_camera);

 private:
  struct View {
    cv::Mat left;
    Eigen::Isometry3d T_odom_camera;
  };
  /// The disparities between which an edge may be.
  struct Span {
    double least = 0.0, most = 0.0;
  };

  void keep(const Eigen::Isometry3d& T_odom_camera);
  const View* partner(const Eigen::Isometry3d& T_odom_camera) const;
  double gradient(int u, int v) const;
  void findRows(int u);
  void lookAt(int u, const cv::Mat& disparity, const DisparityCamera& camera, const FloorPlane& floor);
  bool sweep(int u, int v, const DisparityCamera& camera, double d_floor, Span& span);
  double footDisparity(int u, int v, const FloorPlane& floor, const Span& span) const;

  ObstacleParams params_;
  cv::Mat left_, right_;  ///< smoothed
  std::deque<View> earlier_;
  const View* view_ = nullptr;  ///< the earlier one that is compared with, if there is any
  Eigen::Isometry3d T_earlier_now_ = Eigen::Isometry3d::Identity();
  std::vector<int> rows_;                         ///< of the edges of a column, from the bottom upwards
  std::vector<std::pair<double, double>> costs_;  ///< of disparities
  std::vector<StandingEdge> edges_;
};

}  // namespace stereo_nav::navigation
