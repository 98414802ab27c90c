#include "tools/evaluate/wheel_run.h"

#include <chrono>
#include <filesystem>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "odometry/wheel/wheel_odometry.h"
#include "ros/wheel_recording.h"
#include "tools/evaluate/truth_of_base.h"

namespace stereo_nav::tools {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// What the intervals told of their uncertainty, for the motion between any two readings.
class Steps {
 public:
  Steps(const odometry::WheelOdometryParams& params, const odometry::WheelOdometry& odometry)
      : scale_sigma_(params.scale_sigma), reading_variance_m2_(odometry.readingVariance_m2()) {}

  void add(const odometry::WheelStep& step) { steps_.push_back(step); }

  Matrix6d operator()(std::size_t from, std::size_t to) const {
    odometry::PlanarCovariance covariance(reading_variance_m2_.size(), scale_sigma_);
    for (std::size_t i = from + 1; i <= to; ++i) covariance.append(steps_[i], reading_variance_m2_);
    return spatialCovariance(covariance.covariance());
  }

 private:
  double scale_sigma_;
  std::vector<double> reading_variance_m2_;
  std::vector<odometry::WheelStep> steps_;  ///< one a reading, that of the first is empty
};

struct WheelPass {
  std::vector<eval::FrameRecord> frames;
  Steps steps;
  std::string problem;  ///< the first that the check of the encoders found
};

WheelPass pass(const odometry::WheelOdometryParams& params, const ros_io::WheelRecording& recording) {
  odometry::WheelOdometry odometry(params);
  WheelPass result{{}, Steps(params, odometry), ""};
  for (const auto& sample : recording.samples()) {
    const auto start = SteadyClock::now();
    const odometry::WheelOdometryResult estimate = odometry.process(sample);
    eval::FrameRecord frame;
    frame.timing.frame_ms = std::chrono::duration<double, std::milli>(SteadyClock::now() - start).count();
    frame.time_s = estimate.time_s;
    frame.T_odom_base = inSpace(estimate.T_odom_base);
    frame.pose_covariance = spatialCovariance(inAxesOf(estimate.T_odom_base, estimate.pose_covariance));
    result.frames.push_back(frame);
    result.steps.add(odometry.lastStep());
    if (result.problem.empty()) result.problem = estimate.problem;
  }
  return result;
}

}  // namespace

EvaluationRun runWheelEvaluation(const EvaluateOptions& options) {
  const odometry::WheelOdometryParams params =
      odometry::loadWheelOdometry(options.config, RigFile::load(options.rig));
  const ros_io::WheelRecording recording(options.bag, params.drive,
                                         {options.part.start_s, options.part.duration_s, true});
  EvaluationRun run;
  run.input.input = std::filesystem::path(options.bag).filename().string();
  run.input.config = std::filesystem::path(options.rig).filename().string();
  run.input.planar = true;
  run.input.notes = recording.notes();
  run.input.imu_set_aside = recording.imuSetAside();
  if (!recording.imuSetAside().empty())
    run.input.notes.push_back("the IMU is set aside, the yaw is that of the wheels: " +
                              recording.imuSetAside());
  run.input.ground_truth = truthOfBase(options, recording.robot()).trajectory;
  run.input.segment_lengths_m = options.segment_lengths_m;
  run.input.truth_sigma_m = options.truth_sigma_m;
  run.input.truth_sigma_rad = options.truth_sigma_deg / kDegPerRad;
  for (int repetition = 0; repetition < options.repeat; ++repetition) {
    WheelPass result = pass(params, recording);
    for (const auto& frame : result.frames) run.timings.push_back(frame.timing);
    if (repetition > 0) continue;
    run.input.frames = std::move(result.frames);
    run.input.relative_covariance = std::move(result.steps);
    if (!result.problem.empty()) run.input.notes.push_back(result.problem);
  }
  return run;
}

}  // namespace stereo_nav::tools
