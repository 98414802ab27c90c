#include "tools/evaluate/laser_run.h"

#include <filesystem>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "core/processor_time.h"
#include "odometry/laser/laser_odometry.h"
#include "odometry/laser/motion_covariance.h"
#include "ros/laser_feed.h"
#include "ros/laser_recording.h"
#include "stereo_nav/core/parameters.h"
#include "stereo_nav/ros/topics.h"
#include "tools/evaluate/truth_of_base.h"

namespace stereo_nav::tools {
namespace {

using odometry::Matrix9d;

/// What the scans told of their uncertainty, for the motion between any two of them.
class LaserSteps {
 public:
  void add(const odometry::PoseFilter& filter) {
    steps_.push_back({odometry::momentOf(filter), filter.transition()});
  }

  Matrix6d operator()(std::size_t from, std::size_t to) const {
    Matrix9d carry = Matrix9d::Identity();
    for (std::size_t i = from + 1; i <= to; ++i) carry = (steps_[i].transition * carry).eval();
    return spatialCovariance(odometry::motionCovariance(steps_[from].moment, carry, steps_[to].moment));
  }

 private:
  struct Step {
    odometry::FilterMoment moment;
    Matrix9d transition;
  };
  std::vector<Step> steps_;
};

struct LaserPass {
  std::vector<eval::FrameRecord> frames;
  LaserSteps steps;
};

LaserPass laserPass(const odometry::LaserParams& params, const ros_io::LaserRecording& recording,
                    bool with_prior) {
  odometry::LaserOdometry odometry(params);
  ros_io::LaserFeed feed(recording, odometry);
  LaserPass result;
  for (const odometry::LaserScan& scan : recording.scans()) {
    if (with_prior) feed.upTo(scan.time_s + scan.sweep_s());
    const double start_ms = processorTime_ms();
    const odometry::LaserOdometryResult estimate = odometry.process(scan, recording.T_base_laser());
    eval::FrameRecord frame;
    frame.timing.frame_ms = processorTime_ms() - start_ms;
    frame.time_s = estimate.time_s;
    frame.clock_offset_s = recording.robot().clock().offset_s(estimate.time_s);
    frame.T_odom_base = inSpace(estimate.T_odom_base);
    frame.pose_covariance = spatialCovariance(estimate.pose_covariance);
    frame.reason = estimate.reason;
    frame.features = static_cast<unsigned>(estimate.points);
    frame.inliers = static_cast<unsigned>(estimate.inlier_share * static_cast<double>(estimate.points));
    result.frames.push_back(frame);
    result.steps.add(odometry.filter());
  }
  return result;
}

/// How far the wheels had rolled at each scan.
std::vector<double> wayOfWheels(const ros_io::LaserRecording& recording) {
  std::vector<double> way_m;
  const Trajectory& wheels = recording.wheels();
  std::size_t next = 0;
  double rolled_m = 0.0;
  for (const odometry::LaserScan& scan : recording.scans()) {
    for (; next + 1 < wheels.size() && wheels[next + 1].time_s <= scan.time_s; ++next)
      rolled_m +=
          (wheels[next + 1].T_world_body.translation() - wheels[next].T_world_body.translation()).norm();
    way_m.push_back(rolled_m);
  }
  return way_m;
}

}  // namespace

EvaluationRun runLaserEvaluation(const EvaluateOptions& options) {
  odometry::LaserParams params;
  readParameters(loadYamlFile(options.config), options.config, params);
  const ros_io::LaserRecording recording(options.bag, {options.part.start_s, options.part.duration_s});
  EvaluationRun run;
  run.input.input = std::filesystem::path(options.bag).filename().string();
  run.input.config = std::filesystem::path(options.config).filename().string();
  run.input.planar = true;
  run.input.notes = recording.robot().notes();
  run.input.imu_set_aside = recording.imu().set_aside;
  const ros_io::BasePoses truth = truthOfBase(options, recording.robot());
  run.input.ground_truth = truth.trajectory;
  if (truth.world_frame == ros_io::frames::kCorrectedMap) run.input.way_m = wayOfWheels(recording);
  run.input.truth_sigma_m = options.truth_sigma_m;
  run.input.truth_sigma_rad = options.truth_sigma_deg / kDegPerRad;
  run.input.segment_lengths_m = options.segment_lengths_m;
  for (int repetition = 0; repetition < options.repeat; ++repetition) {
    LaserPass result = laserPass(params, recording, !options.no_prior);
    for (const auto& frame : result.frames) run.timings.push_back(frame.timing);
    if (repetition > 0) continue;
    run.input.frames = std::move(result.frames);
    run.input.relative_covariance = std::move(result.steps);
  }
  return run;
}

}  // namespace stereo_nav::tools
