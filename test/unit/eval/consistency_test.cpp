// Covariances held against errors that were drawn from them.
#include "eval/consistency.h"

#include <gtest/gtest.h>

#include <random>

namespace stereo_nav::eval {
namespace {

constexpr double kFrame_s = 0.1;
constexpr double kStepSigma_m = 0.02, kStepSigma_rad = 0.01;

/// A robot at rest whose odometry drifts by random steps; the covariance of each is known.
class ConsistencyTest : public testing::Test {
 protected:
  Vector6d drawn(double sigma_m, double sigma_rad) {
    Vector6d noise;
    for (Eigen::Index i = 0; i < 6; ++i) noise[i] = normal_(random_) * (i < 3 ? sigma_m : sigma_rad);
    return noise;
  }

  EvaluationInput drift(int frames) {
    EvaluationInput input;
    Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
    for (int i = 0; i < frames; ++i) {
      FrameRecord frame;
      frame.time_s = kFrame_s * i;
      frame.T_odom_base = T_odom_base;
      input.frames.push_back(frame);
      input.ground_truth.push_back({frame.time_s, Eigen::Isometry3d::Identity()});
      T_odom_base = T_odom_base * expMotion(drawn(kStepSigma_m, kStepSigma_rad));
    }
    input.relative_covariance = [](std::size_t from, std::size_t to) -> Matrix6d {
      Vector6d variances;
      variances << Eigen::Vector3d::Constant(kStepSigma_m * kStepSigma_m),
          Eigen::Vector3d::Constant(kStepSigma_rad * kStepSigma_rad);
      return static_cast<double>(to - from) * variances.asDiagonal().toDenseMatrix();
    };
    return input;
  }

  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
};

TEST_F(ConsistencyTest, TrueCovariancesGiveWhatChiSquareExpects) {
  const Nees nees = neesOver(0.2, drift(20001));
  EXPECT_EQ(nees.pairs, 10000u);
  // The mean of 10000 draws of chi-square with n degrees of freedom has a sigma of sqrt(2 n) / 100.
  EXPECT_NEAR(nees.mean, 6.0, 0.14);
  EXPECT_NEAR(nees.translation, 3.0, 0.1);
  EXPECT_NEAR(nees.rotation, 3.0, 0.1);
  EXPECT_NEAR(nees.inside_95_percent, 95.0, 0.9);
}

TEST_F(ConsistencyTest, InThePlaneThreeAxesCount) {
  EvaluationInput input = drift(20001);
  input.planar = true;
  const auto truth = input.relative_covariance;
  input.relative_covariance = [truth](std::size_t from, std::size_t to) -> Matrix6d {
    Matrix6d covariance = truth(from, to);
    covariance.diagonal().segment<3>(2).setConstant(1e6);  // z, roll and pitch are not known
    return covariance;
  };
  const Nees nees = neesOver(0.2, input);
  EXPECT_EQ(nees.expected, 3);
  EXPECT_NEAR(nees.mean, 3.0, 0.1);
  EXPECT_NEAR(nees.translation, 2.0, 0.08);
  EXPECT_NEAR(nees.rotation, 1.0, 0.06);
  EXPECT_NEAR(nees.inside_95_percent, 95.0, 0.9);
}

TEST_F(ConsistencyTest, AnErrorOfTwiceTheSigmaCountsFourTimes) {
  EvaluationInput input = drift(20001);
  const auto truth = input.relative_covariance;
  input.relative_covariance = [truth](std::size_t from, std::size_t to) -> Matrix6d {
    return 0.25 * truth(from, to);
  };
  const Nees nees = neesOver(0.2, input);
  EXPECT_NEAR(nees.mean, 24.0, 0.6);
  EXPECT_LT(nees.inside_95_percent, 50.0);
}

TEST_F(ConsistencyTest, TheNoiseOfTheGroundTruthIsNotBlamedOnTheOdometry) {
  EvaluationInput input = drift(20001);
  constexpr double kSigma_m = 0.1, kSigma_rad = 0.03;
  for (StampedPose& truth : input.ground_truth) truth.T_world_body = expMotion(drawn(kSigma_m, kSigma_rad));
  EXPECT_GT(neesOver(0.2, input).mean, 60.0);
  input.truth_sigma_m = kSigma_m;
  input.truth_sigma_rad = kSigma_rad;
  EXPECT_NEAR(neesOver(0.2, input).mean, 6.0, 0.3);
}

TEST_F(ConsistencyTest, PiecesEndAtFramesThatHaveAPoseAndATruth) {
  EvaluationInput input = drift(101);  // 10 s
  EXPECT_EQ(neesOver(1.0, input).pairs, 10u);
  EXPECT_EQ(neesOver(60.0, input).pairs, 0u);
  for (std::size_t i = 30; i < 35; ++i) input.frames[i].T_odom_base.reset();
  // 0-1, 1-2, then 2 to 3.5 s, 3.5-4.5, ..., 8.5-9.5.
  EXPECT_EQ(neesOver(1.0, input).pairs, 9u);
}

}  // namespace
}  // namespace stereo_nav::eval
