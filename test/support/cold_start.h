#pragma once

#include <string>
#include <vector>

#include "sim/renderer.h"
#include "stereo_nav/core/imu_sample.h"
#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::test {

/// How often an odometry that has just been switched on was wrong while it called itself TRACKING.
struct ColdStartCounts {
  int frames = 0;
  int tracking = 0;
  int outside = 0;  ///< of those: error of the pose outside the 99.73 % ellipsoid of the published covariance
  int beyond = 0;   ///< of those: at a Mahalanobis distance beyond 6
  int wrong = 0;    ///< of those: by more than the larger of 5 cm and 2 % of the path since the map began
  int begun = 0;    ///< 1 where any frame is TRACKING
  double worst = 0.0;  ///< largest Mahalanobis distance while TRACKING

  ColdStartCounts& operator+=(const ColdStartCounts& other);
};

/// A rig that is switched on in the midst of its motion: 2.5 s of stereo pairs at 10 Hz, 320x240, of a
/// simulated hall as large as the speed asks for, with or without an IMU. Deterministic in its number.
class ColdStart {
 public:
  enum class Kind { kTurning, kFast, kBlurred, kCovered };
  static constexpr int kKinds = 4;

  /// `number` from 0 on; the kinds take turns, and four starts in a row have an IMU, the next four none.
  explicit ColdStart(int number);

  Kind kind() const { return kind_; }
  /// What moves how, for people.
  std::string text() const;

  /// Runs the odometry with the default parameters, as the node and `evaluate` do.
  ColdStartCounts run() const;

 private:
  static constexpr double kPeriod_s = 0.1;
  static constexpr int kFrames = 26;

  Eigen::Isometry3d basePose(double time_s) const;
  sim::SceneParams scene() const;
  sim::CameraCalibration camera() const;
  vision::StereoCalibration calibration() const;
  cv::Mat image(const sim::Scene& scene, const sim::Renderer& renderer, bool is_right, int frame) const;
  void cover(bool is_right, int frame, cv::Mat& light) const;
  std::vector<ImuSample> imu(double from_s, double to_s) const;

  int number_;
  Kind kind_;
  bool has_imu_;
  bool is_bare_;  ///< plain walls and little before them
  double speed_m_s_ = 0.0;
  double acceleration_m_s2_ = 0.0;
  double turn_rad_s_ = 0.0;
  double exposure_s_ = 0.005;
  double baseline_m_ = 0.12;
  Eigen::Vector3d gyro_bias_rad_s_ = Eigen::Vector3d::Zero();
};

}  // namespace stereo_nav::test
