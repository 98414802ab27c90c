#include "tools/fuse/fuse_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::tools {
namespace {

using FusionClock = std::chrono::steady_clock;

estimation::FusionConfig readConfig(const FuseOptions& options) {
  estimation::FusionConfig config =
      estimation::readFusionConfig(loadYamlFile(options.config), options.config);
  const auto unused = [&options](const estimation::SensorConfig& sensor) {
    return options.only.count(sensor.name) == 0;
  };
  if (options.only.empty()) return config;
  config.sensors.erase(std::remove_if(config.sensors.begin(), config.sensors.end(), unused),
                       config.sensors.end());
  if (config.sensors.size() != options.only.size())
    throw InputError(options.config + ": --only names a sensor that the file does not have");
  return config;
}

Trajectory truthOf(const FuseOptions& options, const ros_io::RecordedRobot& robot) {
  if (!options.ground_truth || !std::filesystem::exists(*options.ground_truth))
    return robot
        .poses(options.ground_truth.value_or(ros_io::topics::kGroundTruth), options.ground_truth.has_value(),
               options.ground_truth_frame)
        .trajectory;
  const Trajectory truth = readTum(*options.ground_truth);
  const std::string frame = options.ground_truth_frame.value_or(ros_io::frames::kBase);
  return frame == ros_io::frames::kBase ? truth : ofOtherBody(truth, robot.T_base(frame).inverse());
}

/// Takes the measurements in as they were received and notes the pose at the filter's frequency.
void pass(const estimation::FusionParams& params, const FusionInput& input, estimation::FusionFilter& filter,
          FuseRun& run) {
  double next_s = ros::TIME_MIN.toSec();
  const double first_s = input.measurements.empty() ? 0.0 : input.measurements.front().received_s;
  for (const ReceivedMeasurement& received : input.measurements) {
    const auto start = FusionClock::now();
    filter.add(received.measurement, received.received_s);
    eval::FrameTiming timing;
    timing.frame_ms = std::chrono::duration<double, std::milli>(FusionClock::now() - start).count();
    run.timings.push_back(timing);
    for (const std::string& text : filter.takeAnnouncements())
      run.announcements.push_back(fmt::format("{:.2f} s: {}", received.received_s - first_s, text));
    if (received.received_s < next_s || !filter.started()) continue;
    next_s = std::max(next_s + 1.0 / params.frequency_hz, received.received_s);
    const estimation::FusedEstimate estimate =
        filter.estimate(params.predict_to_current_time ? received.received_s : filter.time_s());
    if (!run.input.frames.empty() && estimate.time_s <= run.input.frames.back().time_s) continue;
    eval::FrameRecord frame;
    frame.time_s = estimate.time_s;
    frame.T_odom_base = estimate.T_world_base;
    frame.pose_covariance = estimate.pose_covariance;
    run.input.frames.push_back(frame);
  }
}

}  // namespace

FuseRun runFusion(const FuseOptions& options) {
  const estimation::FusionConfig config = readConfig(options);
  const estimation::FusionSetup setup = estimation::setUp(config);
  const ros_io::RecordedRobot robot(options.bag);
  FusionInput input = readFusionInput(options, robot, config, setup);
  FuseRun run;
  run.input.input = std::filesystem::path(options.bag).filename().string();
  run.input.config = std::filesystem::path(options.config).filename().string();
  run.input.planar = config.params.two_d_mode;
  run.input.notes = config.notes;
  run.input.notes.insert(run.input.notes.end(), robot.notes().begin(), robot.notes().end());
  run.input.notes.insert(run.input.notes.end(), input.notes.begin(), input.notes.end());
  run.input.ground_truth = truthOf(options, robot);
  estimation::FusionFilter filter(config.params.filter, setup.parts, setup.channels);
  pass(config.params, input, filter, run);
  run.channels = setup.channels;
  run.statistics = filter.statistics();
  run.measurements = input.measurements.size();
  return run;
}

}  // namespace stereo_nav::tools
