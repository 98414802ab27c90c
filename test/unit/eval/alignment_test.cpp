#include "eval/alignment.h"

#include "eval/metrics.h"
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

TEST(AlignRigidly, findsTheMotionThatMovedThePoints) {
  const std::vector<Eigen::Vector3d> source = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  const Eigen::Isometry3d T = pose(4, -5, 6, 120.0) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX());
  std::vector<Eigen::Vector3d> target;
  for (const auto& point : source) target.push_back(T * point);
  EXPECT_TRUE(alignRigidly(source, target).isApprox(T, 1e-12));
}

TEST(AlignRigidly, keepsTheScale) {
  // Stretched about the middle by 10 %: nothing to rotate or shift, every point stays 0.1 m off.
  const std::vector<Eigen::Vector3d> source = {{-1.1, 0, 0}, {1.1, 0, 0}, {0, -1.1, 0}, {0, 1.1, 0}};
  const std::vector<Eigen::Vector3d> target = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
  EXPECT_TRUE(alignRigidly(source, target).isApprox(Eigen::Isometry3d::Identity(), 1e-12));
  EXPECT_NEAR(rmse(source, target), 0.1, 1e-12);
}

TEST(AlignRigidly, straightLinesAndMirroredPointsStillGiveARotation) {
  const std::vector<Eigen::Vector3d> along_x = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Eigen::Vector3d> along_y = {{5, 0, 0}, {5, 1, 0}, {5, 2, 0}};
  const auto T = alignRigidly(along_x, along_y);
  EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-12);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE((T * along_x[i]).isApprox(along_y[i], 1e-12));

  const std::vector<Eigen::Vector3d> corner = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  const std::vector<Eigen::Vector3d> mirrored = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  EXPECT_NEAR(alignRigidly(corner, mirrored).linear().determinant(), 1.0, 1e-12);

  EXPECT_TRUE(alignRigidly({{1, 2, 3}}, {{1, 2, 4}}).translation().isApprox(Eigen::Vector3d(0, 0, 1)));
  EXPECT_THROW(alignRigidly({}, {}), std::invalid_argument);
  EXPECT_THROW(alignRigidly(along_x, {{0, 0, 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace stereo_nav::eval
