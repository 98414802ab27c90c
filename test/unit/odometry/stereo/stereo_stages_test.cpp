#include <gtest/gtest.h>

#include <random>

#include "odometry/common/exact_clique.h"
#include "odometry/common/greedy_clique.h"
#include "odometry/stereo/imu_rotation.h"
#include "odometry/stereo/noisy_rigidity.h"
#include "support/textured_room.h"
#include "synthetic_map.h"
#include "vision/grid_corner_detector.h"
#include "vision/sparse_stereo.h"

namespace stereo_nav::odometry {
namespace {

ConsistencyGraph randomGraph(std::size_t size, double density, unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution edge(density);
  ConsistencyGraph graph(size);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = i + 1; j < size; ++j) {
      if (edge(random)) graph.connect(i, j);
    }
  }
  return graph;
}

std::size_t largestByBruteForce(const ConsistencyGraph& graph) {
  std::size_t largest = 0;
  for (unsigned set = 0; set < 1U << graph.size(); ++set) {
    bool clique = true;
    for (std::size_t i = 0; i < graph.size() && clique; ++i) {
      for (std::size_t j = i + 1; j < graph.size() && clique; ++j) {
        if ((set >> i & 1U) != 0 && (set >> j & 1U) != 0) clique = graph.connected(i, j);
      }
    }
    if (clique) largest = std::max(largest, static_cast<std::size_t>(__builtin_popcount(set)));
  }
  return largest;
}

TEST(ExactCliqueTest, IsAsLargeAsBruteForceFinds) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const ConsistencyGraph graph = randomGraph(14, 0.3 + 0.02 * seed, seed);
    const CliqueResult clique = largestClique(graph, 100000);
    EXPECT_TRUE(clique.optimal);
    EXPECT_EQ(clique.members.size(), largestByBruteForce(graph)) << "seed " << seed;
    for (const std::size_t i : clique.members) {
      for (const std::size_t j : clique.members) EXPECT_TRUE(i == j || graph.connected(i, j));
    }
  }
}

TEST(ExactCliqueTest, TheBudgetEndsTheSearchWithTheBestSoFar) {
  const ConsistencyGraph graph = randomGraph(150, 0.9, 4);
  const CliqueResult clique = largestClique(graph, 50);
  EXPECT_FALSE(clique.optimal);
  EXPECT_LE(clique.expanded, 50u);
  EXPECT_GE(clique.members.size(), greedyClique(graph).size());
  EXPECT_TRUE(largestClique(ConsistencyGraph(0), 50).members.empty());
}

TEST(NoisyRigidityTest, KeepsTheRigidAndFindsTheMover) {
  const vision::StereoCalibration calibration = test::roomCalibration();
  Vector6d twist;
  twist << 0.1, 0.0, -0.2, 0.0, 0.05, 0.0;
  const Eigen::Isometry3d T = expMotion(twist);
  std::vector<RigidPoint> points;
  for (const Eigen::Vector3d& p : test::pointsAhead(40, 2)) points.push_back({p, T * p});
  points.push_back({{0.2, 0.1, 2.0}, T * Eigen::Vector3d(0.7, 0.1, 2.0)});
  const ConsistencyGraph graph = buildNoisyRigidityGraph(NoisyRigidityParams(), calibration, points);
  const CliqueResult clique = largestClique(graph, 10000);
  ASSERT_GE(clique.members.size(), 40u);
  EXPECT_EQ(clique.members.back(), 39u) << "the mover is the 41st";
}

TEST(NoisyRigidityTest, FarPointsAreJudgedByTheirOwnNoise) {
  const vision::StereoCalibration calibration = test::roomCalibration();
  // Coming nearer by 1 m cannot be detected at 40 m, and is far too much at 2 m.
  const std::vector<RigidPoint> far = {{{0, 0, 40}, {0, 0, 39}}, {{5, 0, 40}, {5, 0, 40}}};
  const std::vector<RigidPoint> near = {{{0, 0, 2}, {0, 0, 1}}, {{0.5, 0, 2}, {0.5, 0, 2}}};
  EXPECT_TRUE(buildNoisyRigidityGraph(NoisyRigidityParams(), calibration, far).connected(0, 1));
  EXPECT_FALSE(buildNoisyRigidityGraph(NoisyRigidityParams(), calibration, near).connected(0, 1));
}

class RoomPairTest : public ::testing::Test {
 protected:
  test::TexturedRoom room;
  vision::StereoCalibration calibration = test::roomCalibration();
  cv::Size size{calibration.width, calibration.height};
};

TEST_F(RoomPairTest, CornersFillTheImageWithoutCrowding) {
  const auto pair =
      room.renderPair(Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity(), calibration);
  vision::GridCornerDetectorParams params;
  params.features = 150;
  vision::GridCornerDetector detector(params, size);
  const auto corners = detector.detect(pair.left, {});
  ASSERT_GE(corners.size(), 100u);
  ASSERT_LE(corners.size(), 150u);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      EXPECT_GE(cv::norm(corners[i] - corners[j]), params.min_distance_px);
    }
  }
  EXPECT_TRUE(detector.detect(pair.left, std::vector<cv::Point2f>(150, {10.0F, 10.0F})).empty());
  const auto others = detector.detect(pair.left, {corners.begin(), corners.begin() + 100});
  EXPECT_LE(others.size(), 50u);
  EXPECT_TRUE(vision::GridCornerDetector(params, size).detect(cv::Mat::zeros(size, CV_8UC1), {}).empty());
}

TEST_F(RoomPairTest, SparseStereoFindsTheExactDisparity) {
  auto pair = room.renderPair(Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity(), calibration);
  pair.right = 0.7 * pair.right + 30.0;  // the other camera's exposure
  const cv::Mat truth = room.disparity(Eigen::Isometry3d::Identity(), calibration);
  const vision::ImagePyramid left(pair.left, 4);
  const vision::ImagePyramid right(pair.right, 4);
  const vision::SparseStereoMatcher matcher(vision::SparseStereoParams(), calibration);
  int matched = 0;
  int good = 0;
  for (const cv::Point2f& corner :
       vision::GridCornerDetector(vision::GridCornerDetectorParams(), size).detect(pair.left, {})) {
    const Eigen::Vector2d px(static_cast<double>(corner.x), static_cast<double>(corner.y));
    const auto match = matcher.search(left, right, Eigen::Isometry3d::Identity(), px, 0.0);
    if (!match) continue;
    ++matched;
    const double disparity_px = match->depth.inverse_depth * calibration.fx * calibration.baseline_m;
    const auto expected_px =
        static_cast<double>(truth.at<float>(static_cast<int>(corner.y), static_cast<int>(corner.x)));
    if (std::abs(disparity_px - expected_px) < 0.3) ++good;
  }
  EXPECT_GE(matched, 60);
  EXPECT_GE(good, matched * 9 / 10);
}

TEST(ImuRotationTest, LearnsTheBiasFromVision) {
  const Eigen::Matrix3d R_camera_imu = expRotation({0.4, -1.0, 0.3});
  const Eigen::Vector3d bias_imu(0.08, -0.05, 0.02);
  const Eigen::Vector3d rate_camera(0.1, 0.2, -0.3);
  ImuRotation imu(ImuRotationParams(), R_camera_imu);
  for (int i = 0; i <= 1000; ++i) {
    ImuSample sample;
    sample.time_s = 0.005 * i;
    sample.angular_velocity = R_camera_imu.transpose() * rate_camera + bias_imu;
    imu.add(sample);
  }
  const auto before = imu.increment(0.0, 0.1);
  ASSERT_TRUE(before);
  const Eigen::Matrix3d truth = expRotation(-0.1 * rate_camera);
  EXPECT_GT(logRotation(before->R_current_previous * truth.transpose()).norm(), 0.005);
  for (int i = 0; i < 20; ++i) imu.learn(0.1 * i, 0.1 * (i + 1), truth, 0.0005);
  const auto after = imu.increment(3.0, 3.1);
  ASSERT_TRUE(after);
  EXPECT_LT(logRotation(after->R_current_previous * truth.transpose()).norm(), 2e-4);
  EXPECT_LT(after->sigma_rad, before->sigma_rad);
  EXPECT_TRUE(imu.bias().isApprox(R_camera_imu * bias_imu, 0.03));
  EXPECT_FALSE(imu.increment(9.0, 9.1));
}

TEST(ImuRotationTest, ARotationThatNoBiasExplainsIsNotLearned) {
  ImuRotation imu(ImuRotationParams(), Eigen::Matrix3d::Identity());
  for (int i = 0; i <= 100; ++i) {
    ImuSample sample;
    sample.time_s = 0.01 * i;
    sample.angular_velocity = Eigen::Vector3d::Zero();
    imu.add(sample);
  }
  imu.learn(0.0, 0.1, expRotation({0.5, 0.0, 0.0}), 0.0005);
  EXPECT_TRUE(imu.bias().isZero());
}

}  // namespace
}  // namespace stereo_nav::odometry
