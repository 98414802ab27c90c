#include <gtest/gtest.h>

#include "core/statistics.h"
#include "mapping/loop/keyframe_chain.h"
#include "mapping/loop/loop_pose.h"
#include "mapping/loop/pose_ransac.h"
#include "unit/mapping/loop/landmark_world.h"

namespace stereo_nav::mapping {
namespace {

Eigen::Isometry3d somePose() {
  Vector6d twist;
  twist << 0.3, -0.1, 0.2, 0.05, -0.2, 0.1;
  return expMotion(twist);
}

/// Landmarks of a place and where a query in the pose T_query_place sees them, with noise.
std::vector<LandmarkMatch> noisyMatches(const Eigen::Isometry3d& T_query_place, int count,
                                        std::mt19937_64& random) {
  const vision::StereoCalibration camera = testCamera();
  std::uniform_real_distribution<double> column(50.0, 590.0), row(50.0, 430.0), depth(1.0, 8.0);
  std::normal_distribution<double> normal;
  std::vector<LandmarkMatch> matches;
  while (matches.size() < static_cast<std::size_t>(count)) {
    const double disparity_px = camera.fx * camera.baseline_m / depth(random);
    const Eigen::Vector3d p_place = camera.backProject(column(random), row(random), disparity_px);
    const Eigen::Vector3d p_query = T_query_place * p_place;
    if (p_query.z() < 0.5) continue;
    const Eigen::Vector3d seen = measurementOf(camera, p_query), at_place = measurementOf(camera, p_place);
    LandmarkMatch match;
    vision::KeyframeCorner corner;
    corner.disparity_sigma_px = 0.3;
    corner.px = at_place.head<2>();
    corner.disparity_px = std::max(0.5, at_place.z() + corner.disparity_sigma_px * normal(random));
    setPoint(camera, corner, match);
    match.seen.px = seen.head<2>() + kCornerSigma_px * Eigen::Vector2d(normal(random), normal(random));
    match.seen.disparity_sigma_px = 0.3;
    match.seen.disparity_px = std::max(0.5, seen.z() + 0.3 * normal(random));
    matches.push_back(match);
  }
  return matches;
}

void addOutliers(int count, std::mt19937_64& random, std::vector<LandmarkMatch>& matches) {
  std::uniform_real_distribution<double> column(0.0, 640.0), row(0.0, 480.0);
  for (int i = 0; i < count; ++i) {
    matches.push_back(matches[static_cast<std::size_t>(i)]);
    matches.back().seen.px << column(random), row(random);
  }
}

TEST(LandmarkMatchTest, JacobiansAgreeWithNumericDifferences) {
  const vision::StereoCalibration camera = testCamera();
  std::mt19937_64 random(5);
  const Eigen::Isometry3d T = somePose();
  constexpr double kStep = 1e-6;
  for (const LandmarkMatch& match : noisyMatches(T, 10, random)) {
    const Eigen::Vector3d p_query = T * match.p_place;
    const Eigen::Matrix3d by_point = measurementJacobian(camera, p_query);
    const auto residual = residualOf(camera, T, match);
    ASSERT_TRUE(residual);
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(i);
      const Eigen::Vector3d numeric =
          (measurementOf(camera, p_query + step) - measurementOf(camera, p_query - step)) / (2.0 * kStep);
      EXPECT_LT((by_point.col(i) - numeric).norm(), 1e-4);
    }
    for (int i = 0; i < 6; ++i) {
      const Vector6d step = kStep * Vector6d::Unit(i);
      const Eigen::Vector3d numeric = (measurementOf(camera, expMotion(step) * p_query) -
                                       measurementOf(camera, expMotion(-step) * p_query)) /
                                      (2.0 * kStep);
      EXPECT_LT((residual->by_pose.col(i) - numeric).norm(), 1e-4);
    }
  }
}

TEST(PoseRansacTest, FindsThePoseAmongAsManyOutliersAndTheSameOneEachTime) {
  std::mt19937_64 random(6);
  const Eigen::Isometry3d T = somePose();
  std::vector<LandmarkMatch> matches = noisyMatches(T, 60, random);
  addOutliers(60, random, matches);
  const auto found = ransacPose({}, testCamera(), matches, 42);
  ASSERT_TRUE(found);
  EXPECT_GT(found->inliers.size(), 45u);
  EXPECT_LT((found->T_query_place.translation() - T.translation()).norm(), 0.1);
  const auto again = ransacPose({}, testCamera(), matches, 42);
  EXPECT_EQ(found->T_query_place.matrix(), again->T_query_place.matrix());
}

TEST(PoseRansacTest, MatchesWithoutACommonPoseAgreeInFew) {
  std::mt19937_64 random(7);
  std::vector<LandmarkMatch> matches = noisyMatches(somePose(), 80, random);
  addOutliers(80, random, matches);
  matches.erase(matches.begin(), matches.begin() + 80);
  const auto found = ransacPose({}, testCamera(), matches, 1);
  EXPECT_TRUE(!found || found->inliers.size() < 10);
  matches.resize(3);
  EXPECT_FALSE(ransacPose({}, testCamera(), matches, 1));
}

TEST(LoopPoseTest, IsNearTheTruthAndItsCovarianceIsThatOfItsErrors) {
  std::mt19937_64 random(8);
  const Eigen::Isometry3d T = somePose();
  constexpr int kRuns = 200;
  double nees = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<LandmarkMatch> matches = noisyMatches(T, 80, random);
    addOutliers(8, random, matches);
    Vector6d off;
    off << 0.05, 0.05, -0.05, 0.02, -0.02, 0.02;
    const auto pose = refineLoopPose(testCamera(), matches, expMotion(off) * T);
    ASSERT_TRUE(pose);
    EXPECT_GT(pose->inliers, 70u);
    const Vector6d error = logMotion(T * pose->T_query_place.inverse());
    EXPECT_LT(error.head<3>().norm(), 0.05);
    nees += error.dot(pose->covariance.ldlt().solve(error));
  }
  // The mean of so many has a sigma of sqrt(2 * 6 / 200) = 0.24; robust weights cost a little.
  EXPECT_NEAR(nees / kRuns, 6.0, 1.2);
}

TEST(LoopPoseTest, FewMatchesTellNothing) {
  std::mt19937_64 random(9);
  EXPECT_FALSE(refineLoopPose(testCamera(), noisyMatches(somePose(), 4, random), somePose()));
  EXPECT_FALSE(refineLoopPose(testCamera(), {}, somePose()));
}

vision::Keyframe link(std::uint32_t id, bool follows) {
  vision::Keyframe keyframe;
  keyframe.id = id;
  keyframe.follows = follows;
  keyframe.T_previous_keyframe = somePose();
  keyframe.covariance = 1e-6 * Matrix6d::Identity();
  return keyframe;
}

TEST(KeyframeChainTest, JoinsMotionsAndTheirCovariances) {
  KeyframeChain chain({0.0, 0.0});
  for (std::uint32_t id = 1; id <= 4; ++id) chain.add(link(id, id > 1));
  const auto forth = chain.relative(1, 3), back = chain.relative(3, 1);
  ASSERT_TRUE(forth && back);
  EXPECT_TRUE(forth->T.isApprox(somePose() * somePose(), 1e-12));
  EXPECT_TRUE(back->T.isApprox(forth->T.inverse(), 1e-12));
  const RelativePose one{somePose(), 1e-6 * Matrix6d::Identity()};
  EXPECT_TRUE(forth->covariance.isApprox(composed(one, one).covariance, 1e-9));
  EXPECT_TRUE(inverse(*back).covariance.isApprox(forth->covariance, 1e-9));
  EXPECT_NEAR(chain.way_m(0, 3), 3.0 * somePose().translation().norm(), 1e-12);
}

TEST(KeyframeChainTest, KnowsNothingAcrossANewStart) {
  KeyframeChain chain({});
  chain.add(link(1, false));
  chain.add(link(2, true));
  chain.add(link(3, false));
  EXPECT_TRUE(chain.relative(0, 1));
  EXPECT_FALSE(chain.relative(0, 2));
  EXPECT_THROW(chain.add(link(3, true)), std::invalid_argument);
  vision::Keyframe odd = link(4, true);
  odd.corners.resize(2);
  odd.descriptors.resize(3);
  EXPECT_THROW(chain.add(odd), std::invalid_argument);
}

}  // namespace
}  // namespace stereo_nav::mapping
