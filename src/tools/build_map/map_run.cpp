#include "tools/build_map/map_run.h"

#include <filesystem>

#include "core/base_pose.h"
#include "core/processor_time.h"

namespace stereo_nav::tools {
namespace {

/// Where a frame is, by the newest keyframe.
struct FramePlace {
  std::size_t keyframe;
  Eigen::Isometry3d T_keyframe_camera;
  bool is_measured;
};

eval::EvaluationInput inputOf(const BuildMapOptions& options, const KeyframeRun& recorded) {
  eval::EvaluationInput input;
  input.input = std::filesystem::path(options.run.bag).filename().string();
  input.config = std::filesystem::path(options.run.config).filename().string();
  input.T_base_camera = recorded.T_base_camera();
  input.ground_truth = recorded.groundTruth();
  return input;
}

}  // namespace

MapRun buildMap(const BuildMapOptions& options,
                const std::function<void(std::size_t, std::size_t)>& progress) {
  KeyframeRun recorded(options.run);
  MapBuilder builder(options.loop, options.closing, recorded.calibration());
  MapRun run;
  run.before = run.after = inputOf(options, recorded);
  std::vector<FramePlace> places;
  Eigen::Isometry3d T_odom_keyframe = Eigen::Isometry3d::Identity();
  recorded.forEachFrame(
      [&](const RecordedFrame& frame) {
        if (frame.keyframe) {
          T_odom_keyframe = frame.result.T_start_camera;
          const double start_ms = processorTime_ms();
          const auto candidates = builder.add(*frame.keyframe, T_odom_keyframe);
          run.keyframe_ms += frame.describe_ms + processorTime_ms() - start_ms;
          run.candidates.insert(run.candidates.end(), candidates.begin(), candidates.end());
        }
        if (builder.map().keyframes.empty()) return;
        places.push_back({builder.map().keyframes.size() - 1,
                          T_odom_keyframe.inverse() * frame.result.T_start_camera,
                          odometry::isMeasured(frame.result.state)});
        eval::FrameRecord record;
        record.time_s = frame.frame.left_time_s;
        if (places.back().is_measured)
          record.T_odom_base = basePose(recorded.T_base_camera(), frame.result.T_start_camera);
        run.before.frames.push_back(record);
      },
      progress);
  const double start_ms = processorTime_ms();
  builder.close();
  run.closing_ms = processorTime_ms() - start_ms;
  run.map = builder.map();
  run.verdicts = builder.verdicts();
  run.notes = recorded.notes();
  if (!run.map.keyframes.empty()) run.keyframe_ms /= static_cast<double>(run.map.keyframes.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    eval::FrameRecord record = run.before.frames[i];
    const Eigen::Isometry3d T_map_camera =
        run.map.keyframes[places[i].keyframe].T_map_camera * places[i].T_keyframe_camera;
    if (record.T_odom_base) record.T_odom_base = basePose(recorded.T_base_camera(), T_map_camera);
    run.after.frames.push_back(record);
  }
  return run;
}

}  // namespace stereo_nav::tools
