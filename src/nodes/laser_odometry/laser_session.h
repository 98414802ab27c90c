#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "odometry/laser/laser_odometry.h"
#include "stereo_nav/core/imu_sample.h"

namespace stereo_nav::nodes {

/// What the odometry made of a scan.
struct LaserReading {
  std::int64_t stamp_ns = 0;  ///< of the scan, as it came: seconds in a double are not that exact
  odometry::LaserOdometryResult result;
  std::size_t beams = 0;
};

/// What the scans that were due gave.
struct LaserSessionOutput {
  std::vector<LaserReading> readings;
  std::vector<std::string> announcements;  ///< events that the user should know of
  std::string error;                       ///< why the last scan cannot be used; empty where it can
};

/// Counts of the whole run.
struct ScanCounts {
  std::uint64_t received = 0;
  std::uint64_t dropped = 0;
  std::uint64_t partly = 0;
  std::uint64_t coasting = 0;
  std::uint64_t without_prior = 0;  ///< went ahead of wheels or IMU that they had waited for
};

/// The laser odometry of a node. A scan waits for wheels and IMU to cover it to its last beam, `prior_wait_s`
/// at most, and not at all for those that are not heard; and it waits for the mounting of the laser. Starts
/// anew at its last pose when the clock is set back. Knows no topics; not thread-safe.
class LaserSession {
 public:
  /// Throws ParameterError.
  LaserSession(const odometry::LaserParams& params, double prior_wait_s);

  /// A scan that arrives at `now_s`, on a clock that only runs forward. At most 20 wait: of more the oldest
  /// goes ahead without a prior, or is dropped where the mounting is not known.
  void addScan(odometry::LaserScan scan, std::int64_t stamp_ns, double now_s);
  void addWheels(double time_s, const Eigen::Isometry2d& T_wheels_base);
  void addImu(const ImuSample& sample, const Eigen::Matrix3d& R_base_imu);
  /// Nothing: it is not known; scans wait.
  void setMounting(const std::optional<Eigen::Isometry3d>& T_base_laser) { T_base_laser_ = T_base_laser; }

  /// All scans that are due.
  LaserSessionOutput take(double now_s);

  /// The next scan is the origin, and begins the map.
  void reset();
  void setPose(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance);

  const ScanCounts& counts() const { return counts_; }
  /// How far the newest sample lies after the newest scan, s; nothing before there are both.
  std::optional<double> wheelsAhead_s() const { return ahead_s(newest_wheels_s_); }
  std::optional<double> imuAhead_s() const { return ahead_s(newest_imu_s_); }

 private:
  struct Waiting {
    odometry::LaserScan scan;
    std::int64_t stamp_ns;
    double arrival_s;
  };

  std::optional<double> ahead_s(const std::optional<double>& newest_s) const;
  bool covered(const odometry::LaserScan& scan) const;
  bool due(const Waiting& waiting, double now_s) const;
  void restart(double scan_s);
  void process(const Waiting& waiting, LaserSessionOutput& output);

  odometry::LaserParams params_;
  double prior_wait_s_;
  std::unique_ptr<odometry::LaserOdometry> odometry_;
  std::optional<Eigen::Isometry3d> T_base_laser_;
  std::deque<Waiting> waiting_;
  std::optional<odometry::LaserOdometryResult> last_;
  std::optional<double> newest_scan_s_, newest_wheels_s_, newest_imu_s_;
  ScanCounts counts_;
};

}  // namespace stereo_nav::nodes
