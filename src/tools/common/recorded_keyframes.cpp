#include "tools/common/recorded_keyframes.h"

#include <algorithm>

#include "core/processor_time.h"
#include "eval/alignment.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::tools {

KeyframeRun::KeyframeRun(const KeyframeRunOptions& options)
    : recording_(options.bag, options.part),
      processing_(recording_.leftInfo(), recording_.rightInfo(), {}),
      T_base_camera_(requireTransform(recording_, options.bag, ros_io::frames::kBase,
                                      recording_.leftInfo().header.frame_id)),
      imu_(imuMounting(recording_, options.no_imu)),
      truth_(groundTruthOfBase(recording_, options.bag, options.ground_truth, options.ground_truth_frame)),
      odometry_(odometry::loadOdometryConfig(options.config), processing_.calibration(),
                {T_base_camera_.linear(), imu_.R_base_imu}),
      notes_(recording_.notes()) {
  notes_.insert(notes_.end(), processing_.notes().begin(), processing_.notes().end());
  if (!imu_.problem.empty()) notes_.push_back("the IMU is set aside: " + imu_.problem);
}

void KeyframeRun::forEachFrame(const std::function<void(const RecordedFrame&)>& handle,
                               const std::function<void(std::size_t, std::size_t)>& progress) {
  odometry::KeyframeMaker maker;
  ImuFeed feed(recording_);
  std::size_t frames = 0;
  recording_.forEachPair([&](const ros_io::RawPair& pair) {
    const odometry::StereoFrame frame = rectifiedFrame(processing_, pair);
    if (imu_.problem.empty()) feed.feed(std::max(pair.left_time_s, pair.right_time_s), odometry_);
    const odometry::FrameResult result = odometry_.process(frame);
    const double start_ms = processorTime_ms();
    RecordedFrame recorded{frame, result, maker.add(frame, result), std::nullopt, 0.0};
    recorded.describe_ms = processorTime_ms() - start_ms;
    if (const auto T_world_base = eval::poseAt(truth_, pair.left_time_s))
      recorded.T_world_camera = *T_world_base * T_base_camera_;
    handle(recorded);
    progress(++frames, recording_.pairs());
  });
  if (!odometry_.imuProblem().empty())
    notes_.push_back("the IMU contradicts the images and was set aside: " + odometry_.imuProblem());
}

}  // namespace stereo_nav::tools
