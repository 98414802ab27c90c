#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/camera_clocks.h"
#include "sim/distance_sensors.h"
#include "sim/driven_base.h"
#include "sim/driven_body.h"
#include "sim/imu_model.h"
#include "sim/motion_history.h"
#include "sim/stereo_cameras.h"

namespace stereo_nav::sim {

/// A stereo pair that is exposed and not yet rendered: all that its images depend on. Any thread may render
/// it, at any time.
struct StereoShot {
  PairInstants instants;
  std::size_t index;
  ExposureSetting left, right;
  Scene scene;
  MotionHistory motion;

  double time_s(Side side) const { return side == Side::kLeft ? instants.left_s : instants.right_s; }
  const ExposureSetting& exposure(Side side) const { return side == Side::kLeft ? left : right; }
  cv::Mat image(Side side, const StereoCameras& cameras) const;
};

/// Takes what the sensors of a driven robot deliver, in the order in which it is complete. Times are those of
/// the simulation, which begins at 0.
class DrivenSink {
 public:
  virtual ~DrivenSink() = default;
  /// The counters, and the true motion at their time.
  virtual void takeTicks(const SimulatedTicks& ticks, const BaseState& truth) = 0;
  virtual void takeImu(const ImuSample& sample) = 0;
  virtual void takeScan(const laser::Scan& scan) = 0;
  virtual void takeRange(std::size_t finder, double time_s, double range_m) = 0;
  virtual void takeShot(StereoShot shot) = 0;
  /// What the robot touches has changed: the names of all that it touches now.
  virtual void takeContacts(double time_s, const std::vector<std::string>& names) = 0;
};

/// A world with a robot that is driven by cmd_vel. The same commands at the same times give the same results
/// for the same seed. The path of the scenario is not used. Not for several threads.
class DrivenSimulation {
 public:
  DrivenSimulation(const Scenario& scenario, const DrivenRig& rig, const StereoCalibrationPair& calibration,
                   std::uint64_t seed);

  /// A velocity that the base receives now.
  void command(const kinematics::Twist& twist) { base_.command(twist); }
  /// Lets time pass up to `time_s`, in steps of a millisecond, and hands over what is complete by then.
  void advance(double time_s, DrivenSink& sink);

  double time_s() const { return motion_.time_s(); }
  /// Where the robot started.
  const Eigen::Isometry3d& start() const { return start_; }
  /// The true motion now; its world is that of the scenario.
  BaseState state() const { return motion_.state(time_s()); }
  const Scene& scene() const { return scene_; }
  const Scenario& scenario() const { return scenario_; }
  const kinematics::DriveParams& trueWheels() const { return base_.trueWheels(); }
  /// Shared with those who render.
  std::shared_ptr<const StereoCameras> cameras() const { return cameras_; }

 private:
  void moveBase();
  void reportContacts(DrivenSink& sink);
  void deliver(DrivenSink& sink);
  void deliverTicks(DrivenSink& sink);
  void deliverImu(DrivenSink& sink);
  void deliverRanges(DrivenSink& sink);
  void deliverShot(DrivenSink& sink);
  ExposureSetting expose(Side side, double time_s);

  Scenario scenario_;
  DrivenRig rig_;
  Scene scene_;
  MotionHistory motion_;
  Eigen::Isometry3d start_;
  DrivenBase base_;
  DrivenBody body_;
  ImuModel imu_;
  std::vector<LaserModel> lasers_;
  RandomStream range_noise_;
  std::vector<PairInstants> pairs_;
  std::shared_ptr<const StereoCameras> cameras_;
  std::array<std::optional<AutoExposure>, 2> auto_exposure_;
  std::uint64_t next_ticks_ = 0, next_imu_ = 0, next_range_ = 0;
  std::size_t next_pair_ = 0;
  std::vector<std::size_t> touched_;
};

}  // namespace stereo_nav::sim
