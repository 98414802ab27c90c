#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "odometry/wheel/imu_yaw.h"
#include "odometry/wheel/wheel_odometry.h"

namespace stereo_nav::nodes {

/// What the readings that were due gave.
struct WheelSessionOutput {
  std::vector<odometry::WheelOdometryResult> results;
  std::vector<std::string> announcements;  ///< events that the user should know of
};

/// The wheel odometry of a node. A reading waits for the IMU's sample after it, `imu_wait_s` at most, and not
/// at all where no IMU is heard. Starts anew at its last pose when the clock is set back or the counters
/// jump, as they do when their driver is started again. Knows no topics; not thread-safe.
class WheelSession {
 public:
  /// Throws ParameterError for a drive that cannot be used.
  WheelSession(const odometry::WheelOdometryParams& params, double imu_wait_s);

  /// A reading that arrives at `now_s`, on a clock that only runs forward. At most 100 wait; then the oldest
  /// goes ahead without the IMU.
  void addSample(odometry::WheelSample sample, double now_s);
  /// The mounting must be known before the first sample of the IMU.
  void setImuMounting(const Eigen::Matrix3d& R_base_imu) { yaw_.emplace(R_base_imu); }
  bool knowsImu() const { return yaw_.has_value(); }
  void addImu(const ImuSample& sample);

  /// All readings that are due.
  WheelSessionOutput take(double now_s);

  void setPose(const Eigen::Isometry2d& T_odom_base, const Eigen::Matrix3d& covariance);

  std::uint64_t readings() const { return readings_; }
  std::uint64_t readingsDropped() const { return dropped_; }
  std::uint64_t readingsWithoutImu() const { return without_imu_; }

 private:
  struct Waiting {
    odometry::WheelSample sample;
    double arrival_s;
  };

  bool due(const Waiting& waiting, double now_s) const;
  std::string restartReason(const odometry::WheelSample& sample) const;
  void restart();
  void process(odometry::WheelSample sample, WheelSessionOutput& output);

  odometry::WheelOdometryParams params_;
  double imu_wait_s_;
  std::unique_ptr<odometry::WheelOdometry> odometry_;
  std::optional<odometry::ImuYaw> yaw_;
  std::deque<Waiting> waiting_;
  std::optional<odometry::WheelSample> last_;
  std::optional<odometry::WheelOdometryResult> last_result_;
  std::uint64_t readings_ = 0;
  std::uint64_t dropped_ = 0;
  std::uint64_t without_imu_ = 0;
};

}  // namespace stereo_nav::nodes
