#pragma once

#include <optional>
#include <string>
#include <vector>

#include "odometry/laser/laser_params.h"
#include "odometry/laser/laser_scan.h"
#include "odometry/laser/line_map.h"
#include "odometry/laser/measured_motion.h"
#include "odometry/laser/motion_covariance.h"
#include "odometry/laser/pose_filter.h"
#include "odometry/laser/range_flow.h"
#include "odometry/laser/registration.h"
#include "odometry/laser/rest_watch.h"
#include "odometry/laser/search_raster.h"

namespace stereo_nav::odometry {

/// What the laser odometry knows after a scan.
struct LaserOdometryResult {
  enum class State {
    kTracking,  ///< the scan tells all of the motion
    kPartly,    ///< the scan does not tell the motions `untold`; they are the prior's
    kCoasting   ///< the scan tells nothing; the pose is the prior's
  };
  double time_s = 0.0;  ///< the scan's stamp, that of its first beam
  State state = State::kCoasting;
  Eigen::Isometry2d T_odom_base = Eigen::Isometry2d::Identity();
  Eigen::Matrix3d pose_covariance = Eigen::Matrix3d::Zero();  ///< x, y (m), yaw (rad) in the axes of odom
  /// Motion since the last scan over its time: forward m/s, left m/s, rad/s; zero with variances of 1e6 where
  /// there was none.
  Eigen::Vector3d twist = Eigen::Vector3d::Zero();
  Eigen::Matrix3d twist_covariance = Eigen::Vector3d::Constant(1e6).asDiagonal();
  bool wheels = false, gyroscope = false;  ///< whether these made the prior
  std::vector<Eigen::Vector3d> untold;     ///< directions of motion (ToldDirections::untold)
  std::string reason;                      ///< why it coasts, or what is not told; empty while it tracks
  std::size_t points = 0;                  ///< returns of the scan
  double inlier_share = 0.0;               ///< of the points, that lie on the map
  double residual_scale = 1.0;             ///< of their residuals; 1: the noise is as the parameters say
  double least_share = 0.0;                ///< ToldDirections::least_share
  Registration registration;
  bool keyframe = false;  ///< the scan was added to the map
  bool at_rest = false;   ///< RestWatch
};

/// Pose of a base from the scans of a planar laser, with wheels and gyroscope where there are any:
/// 1. wheels and gyroscope, or else the last velocity, predict the pose at the scan and the motion during it;
/// 2. the scan is undistorted along that motion and laid onto the map of the last keyframes;
/// 3. what it does not tell stays the prediction's;
/// 4. the filter learns from it what the wheels' scale, the gyroscope's bias or the velocity are.
/// With LaserMethod::kRangeFlow the motion between two scans is RangeFlow's instead.
class LaserOdometry {
 public:
  explicit LaserOdometry(const LaserParams& params);

  MotionInputs& inputs() { return inputs_; }

  /// Wheels and gyroscope should cover the scan to its last beam. Throws InputError, and changes nothing, for
  /// a stamp that is not later than the last one and for a laser that is tilted.
  LaserOdometryResult process(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser);

  /// Sets the pose at the last scan; `covariance` in the axes of odom. The map begins anew.
  void setPose(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance);

  /// Of the last step.
  const PoseFilter& filter() const { return filter_; }

 private:
  void check(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser) const;
  void followFlow(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser, LaserOdometryResult& result);
  void match(const LaserScan& scan, const Eigen::Isometry3d& T_base_laser, LaserOdometryResult& result);
  void lay(const LaserPoints& points, const Sweep& sweep, LaserOdometryResult& result);
  Registration registerOrSearch(const LaserPoints& points, const Sweep& sweep);
  std::string refusal(const Registration& registration) const;
  bool isKeyframe() const;
  void addKeyframe(const LaserPoints& points, const Sweep& sweep, const Registration& registration);
  void complete(const FilterMoment& before, LaserOdometryResult& result);

  LaserParams params_;
  MotionInputs inputs_;
  PoseFilter filter_;
  LineMap map_;
  SearchRaster raster_;  ///< of the map
  RangeFlow flow_;
  RestWatch rest_;
  std::optional<double> last_s_;
  Eigen::Isometry2d T_odom_keyframe_ = Eigen::Isometry2d::Identity();
  int coasting_ = 0;  ///< scans in succession
  double coasting_s_ = 0.0;
};

}  // namespace stereo_nav::odometry
