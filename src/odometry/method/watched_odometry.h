#pragma once

#include <memory>
#include <string>

#include "odometry/method/imu_contradiction.h"
#include "stereo_nav/odometry/method/odometry_config.h"

namespace stereo_nav::odometry {

/// An odometry that does not believe an IMU which contradicts the images. As long as the two agree, its
/// results are those of the odometry alone, and so is its cost. When frames are lost or the turns disagree,
/// an odometry without IMU runs beside it for some seconds: the default one, since the thesis' method without
/// IMU follows whatever moves. If what this one sees contradicts the IMU, the IMU is set aside and an
/// odometry by vision alone takes over.
class WatchedOdometry : public Odometry {
 public:
  WatchedOdometry(const OdometryConfig& config, const vision::StereoCalibration& calibration,
                  const SensorAxes& axes);

  void addImu(const ImuSample& sample) override;
  FrameResult process(const StereoFrame& frame) override;
  /// The IMU is believed again.
  void reset() override;

  /// Why the IMU is set aside; empty while it is used or there is none.
  const std::string& imuProblem() const { return imu_problem_; }

 private:
  /// The odometry without IMU that runs beside the other one.
  struct Witness {
    std::unique_ptr<Odometry> odometry;
    ImuContradiction contradiction;
    Eigen::Isometry3d T_start_first;  ///< pose of its first frame
    double since_s;
  };

  void remember(const StereoFrame& frame, const FrameResult& result);
  /// It begins with the frame before, whose pose is still good.
  void startWitness();
  /// Lets the witness see the frame; returns its result where it takes over.
  std::optional<FrameResult> askWitness(const StereoFrame& frame);
  /// The odometry of the configuration goes on without IMU; `seen` is the witness' result of the frame.
  FrameResult takeOver(const StereoFrame& frame, FrameResult seen);

  OdometryConfig config_;
  vision::StereoCalibration calibration_;
  SensorAxes axes_;
  std::unique_ptr<Odometry> odometry_;                               ///< the one whose results are handed out
  Eigen::Isometry3d T_start_first_ = Eigen::Isometry3d::Identity();  ///< pose of its first frame
  RotationHistory imu_;
  ImuContradiction contradiction_;  ///< of odometry_, which uses the IMU
  StereoFrame previous_;            ///< the frame before, without disparity map
  State previous_state_ = State::kLost;
  Eigen::Isometry3d T_start_previous_ = Eigen::Isometry3d::Identity();
  std::optional<Witness> witness_;
  std::string imu_problem_;
};

}  // namespace stereo_nav::odometry
