// The errors of a trajectory that is 10 % too long, and the time that its frames took.
#include <stereo_nav/eval/evaluation.h>
#include <stereo_nav/eval/report.h>

#include "expect.h"

int main() {
  stereo_nav::eval::EvaluationInput input;
  std::vector<stereo_nav::eval::FrameTiming> times;
  for (int i = 0; i <= 10; ++i) {
    stereo_nav::StampedPose truth;
    truth.time_s = 0.1 * i;
    truth.T_world_body.translation().x() = 0.1 * i;
    input.ground_truth.push_back(truth);
    stereo_nav::eval::FrameRecord frame;
    frame.time_s = truth.time_s;
    frame.T_odom_base = Eigen::Isometry3d::Identity();
    frame.T_odom_base->translation().x() = 0.11 * i;
    frame.timing.frame_ms = 5.0;
    input.frames.push_back(frame);
    times.push_back(frame.timing);
  }
  const stereo_nav::eval::Evaluation evaluation = stereo_nav::eval::evaluate(input);
  expect(std::abs(evaluation.summary.end_error_percent - 10.0) < 1e-6, "the error at the end is 10 %");
  const auto timing = stereo_nav::eval::summariseTiming(times);
  expect(timing.median_ms == 5.0, "the median of the times is 5 ms");
  stereo_nav::eval::writeReport(".", evaluation, input, timing);
}
