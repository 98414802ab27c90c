#pragma once

#include <vector>

#include "stereo_nav/estimation/floor_constraint.h"
#include "stereo_nav/estimation/odom_covariance.h"

namespace stereo_nav::tools {

/// What poses are computed with beside the odometry itself.
struct PoseParams {
  estimation::UncertaintyParams uncertainty;
  estimation::FloorParams floor;
};

/// What the frames of a run told of their uncertainty, and the poses and covariances that follow from it:
/// those that the node would publish.
class RelativeCovariance {
 public:
  RelativeCovariance(const PoseParams& params, const Eigen::Isometry3d& T_base_camera);

  /// The next frame, taken at `time_s`. Returns its pose.
  estimation::UncertainPose add(odometry::FrameResult result, double time_s);

  /// Of the pose of base_link in frame `to` relative to its pose in frame `from`, axes of base_link in frame
  /// `to`: m, rad.
  Matrix6d operator()(std::size_t from, std::size_t to) const;

 private:
  struct Frame {
    odometry::FrameResult result;  ///< without its features
    double time_s;
  };

  void addMotion(std::size_t frame, estimation::OdomCovariance& covariance) const;

  PoseParams params_;
  Eigen::Isometry3d T_base_camera_;
  estimation::OdomCovariance since_start_;
  std::vector<Frame> frames_;
};

}  // namespace stereo_nav::tools
