#include "eval/alignment.h"

#include "support/trajectories.h"

namespace stereo_nav::eval {
namespace {

TEST(PoseAt, interpolatesBetweenNeighbours) {
  const Trajectory trajectory = {{10.0, pose(0, 0, 0)}, {10.2, pose(1, 2, 0, 90.0)}};
  const auto middle = poseAt(trajectory, 10.05);
  ASSERT_TRUE(middle);
  EXPECT_TRUE(middle->isApprox(pose(0.25, 0.5, 0, 22.5), 1e-9));
  EXPECT_TRUE(poseAt(trajectory, 10.0)->isApprox(pose(0, 0, 0)));
  EXPECT_TRUE(poseAt(trajectory, 10.2)->isApprox(pose(1, 2, 0, 90.0)));
}

TEST(PoseAt, invokesNoPoseInAHoleOrBeyondTheEnds) {
  AssociationParams params;
  params.max_gap_s = 0.5;
  params.max_difference_s = 0.01;
  const Trajectory trajectory = {{1.0, pose(1, 0, 0)}, {2.0, pose(2, 0, 0)}};
  EXPECT_FALSE(poseAt(trajectory, 1.5, params));
  EXPECT_FALSE(poseAt(trajectory, 0.98, params));
  EXPECT_FALSE(poseAt(trajectory, 2.02, params));
  EXPECT_FALSE(poseAt({}, 1.0, params));
  EXPECT_TRUE(poseAt(trajectory, 1.005, params)->isApprox(pose(1, 0, 0)));
  EXPECT_TRUE(poseAt(trajectory, 1.995, params)->isApprox(pose(2, 0, 0)));
  EXPECT_TRUE(poseAt(trajectory, 0.995, params)->isApprox(pose(1, 0, 0)));
  EXPECT_TRUE(poseAt(trajectory, 2.005, params)->isApprox(pose(2, 0, 0)));
}

}  // namespace
}  // namespace stereo_nav::eval
