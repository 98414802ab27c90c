// The check figures of the real recordings, which pin the readers and the path length.
#include <cstdlib>

#include "stereo_nav/core/trajectory.h"
#include "stereo_nav/eval/evaluation.h"
#include "support/trajectories.h"

namespace stereo_nav::eval {
namespace {

class Recordings : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* folder = std::getenv("STEREO_NAV_DATA");
    if (!folder) GTEST_SKIP() << "STEREO_NAV_DATA does not name the folder of the recordings";
    folder_ = folder;
  }
  std::string folder_;
};

TEST_F(Recordings, kitti06) {
  const auto times_s = readKittiTimes(folder_ + "/kitti06_a/times.txt");
  const auto trajectory = readKitti(folder_ + "/kitti06_a/poses.txt", times_s);
  EXPECT_EQ(trajectory.size(), 51u);
  EXPECT_NEAR(pathLength(trajectory), 59.8597, 1e-4);
  const auto chord = trajectory.back().T_world_body.translation() - trajectory[0].T_world_body.translation();
  EXPECT_NEAR(chord.norm(), 59.8585, 1e-4);

  EvaluationInput input;
  input.ground_truth = trajectory;
  for (const auto& pose : trajectory) {
    input.frames.push_back({});
    input.frames.back().time_s = pose.time_s;
    input.frames.back().T_odom_base = pose.T_world_body;
  }
  const auto summary = evaluate(input).summary;
  EXPECT_EQ(summary.segment_lengths_m, (std::vector<double>{5.0, 10.0, 20.0}));
  EXPECT_NEAR(summary.ate_rmse_m, 0.0, 1e-9);
  EXPECT_NEAR(summary.rpe_translation_percent, 0.0, 1e-9);
}

TEST_F(Recordings, eurocMh01) {
  const auto trajectory = readTum(folder_ + "/euroc_mh01_a/groundtruth.tum");
  EXPECT_EQ(trajectory.size(), 2190u);
  // The images are from the middle 9.95 s.
  Trajectory during_images;
  for (const auto& pose : trajectory) {
    if (pose.time_s >= 1403636584.763 && pose.time_s <= 1403636594.714) during_images.push_back(pose);
  }
  EXPECT_NEAR(pathLength(during_images), 3.3, 0.1);
}

}  // namespace
}  // namespace stereo_nav::eval
