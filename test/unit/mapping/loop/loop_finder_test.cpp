#include "mapping/loop/loop_finder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/mapping/loop/landmark_world.h"

namespace stereo_nav::mapping {
namespace {

constexpr int kLap = 40;  ///< keyframes

/// Drives along a circle; `drift` is what the odometry adds to each motion.
class Drive {
 public:
  explicit Drive(const LoopParams& params = {}) : finder_(params, testCamera()) {}

  std::vector<LoopCandidate> step(LandmarkWorld& world, const Vector6d& drift = Vector6d::Zero()) {
    const Eigen::Isometry3d T_world_camera = onCircle(static_cast<double>(count_) / kLap);
    vision::Keyframe keyframe = world.seenFrom(T_world_camera, count_ + 1);
    keyframe.follows = count_ > 0 && !begins_anew_;
    begins_anew_ = false;
    if (keyframe.follows) {
      keyframe.T_previous_keyframe = before_.inverse() * T_world_camera * expMotion(drift);
      keyframe.covariance = 1e-6 * Matrix6d::Identity();
    }
    before_ = T_world_camera;
    ++count_;
    return finder_.add(keyframe);
  }

  /// The odometry does not know how far it is from the last keyframe to the next.
  void beginAnew() { begins_anew_ = true; }

 private:
  LoopFinder finder_;
  Eigen::Isometry3d before_ = Eigen::Isometry3d::Identity();
  std::uint32_t count_ = 0;
  bool begins_anew_ = false;
};

/// Error of an accepted loop: of the right perturbation of the query's pose in the place.
Vector6d errorOf(const LoopCandidate& candidate) {
  const auto at = [](std::size_t keyframe) { return onCircle(static_cast<double>(keyframe) / kLap); };
  const Eigen::Isometry3d T_true = at(candidate.place).inverse() * at(candidate.query);
  return logMotion(candidate.place_query.T.inverse() * T_true);
}

TEST(LoopFinderTest, KnowsTheSecondLapAndWhereItIs) {
  LandmarkWorld world(1);
  Drive drive;
  int accepted = 0, recognised = 0;
  double nees = 0.0;
  for (int i = 0; i < 2 * kLap; ++i) {
    const auto candidates = drive.step(world);
    for (const LoopCandidate& candidate : candidates) {
      if (!candidate.accepted()) continue;
      EXPECT_LT(errorOf(candidate).head<3>().norm(), 0.02);
      EXPECT_LT(errorOf(candidate).tail<3>().norm(), 0.005);
      nees += errorOf(candidate).dot(candidate.place_query.covariance.ldlt().solve(errorOf(candidate)));
      ++accepted;
    }
    if (i >= kLap && !candidates.empty() && candidates.front().accepted()) {
      EXPECT_NEAR(static_cast<double>(candidates.front().place), i - kLap, 3.0);
      ++recognised;
    }
  }
  EXPECT_EQ(recognised, kLap);
  // 6 would be expected if the covariance were that of independent errors, which these are.
  EXPECT_GT(nees / accepted, 1.5);
  EXPECT_LT(nees / accepted, 6.0);
}

TEST(LoopFinderTest, TheFirstLoopWaitsForAnotherOneThatSaysTheSame) {
  LandmarkWorld world(1), elsewhere(7);
  Drive drive;
  for (int i = 0; i < kLap / 4; ++i) drive.step(world);
  for (int i = kLap / 4; i < kLap; ++i) drive.step(elsewhere);
  const auto first = drive.step(world), second = drive.step(world);
  ASSERT_FALSE(first.empty() || second.empty());
  EXPECT_EQ(first.front().stage, LoopStage::kConsistency);
  EXPECT_TRUE(second.front().accepted());
}

TEST(LoopFinderTest, AfterANewStartOfTheOdometryNothingIsKnownOfTheDriftAndTheLoopIsFound) {
  LandmarkWorld world(8);
  Drive drive;
  for (int i = 0; i < kLap; ++i) drive.step(world);
  drive.beginAnew();
  int accepted = 0;
  for (int i = 0; i < 5; ++i) {
    for (const LoopCandidate& candidate : drive.step(world)) {
      if (!candidate.accepted()) continue;
      ++accepted;
      EXPECT_TRUE(std::isnan(candidate.drift_chi2));
      EXPECT_LT(errorOf(candidate).head<3>().norm(), 0.02);
    }
  }
  EXPECT_GE(accepted, 4);
}

TEST(LoopFinderTest, ATwinOfTheRoomFurtherThanTheDriftIsNoLoop) {
  // The second lap sees the same landmarks, but by the odometry the robot has gone elsewhere.
  LandmarkWorld world(2);
  Drive drive;
  Vector6d elsewhere = Vector6d::Zero();
  elsewhere.head<3>() << 0.0, 0.0, 3.0;
  for (int i = 0; i < kLap; ++i) drive.step(world, i == kLap / 2 ? elsewhere : Vector6d::Zero());
  int by_drift = 0;
  for (int i = 0; i < 6; ++i) {
    for (const LoopCandidate& candidate : drive.step(world)) {
      EXPECT_FALSE(candidate.accepted());
      if (candidate.stage != LoopStage::kDrift) continue;
      ++by_drift;
      EXPECT_GT(candidate.figure, candidate.bound);
    }
  }
  EXPECT_GE(by_drift, 4);
}

TEST(LoopFinderTest, AnotherRoomIsNoLoopAndEachCandidateSaysWhy) {
  LandmarkWorld world(3), other(4);
  Drive drive;
  for (int i = 0; i < kLap; ++i) drive.step(world);
  for (int i = 0; i < 10; ++i) {
    for (const LoopCandidate& candidate : drive.step(other)) {
      EXPECT_EQ(candidate.stage, LoopStage::kMatches);
      EXPECT_LT(candidate.figure, candidate.bound);
      EXPECT_NE(candidate.reason().find("mutual matches"), std::string::npos);
    }
  }
}

TEST(LoopFinderTest, TwoRunsGiveTheSame) {
  std::vector<Eigen::Matrix4d> poses[2];
  for (auto& found : poses) {
    LandmarkWorld world(5);
    Drive drive;
    for (int i = 0; i < kLap + 5; ++i) {
      for (const LoopCandidate& candidate : drive.step(world))
        found.push_back(candidate.place_query.T.matrix());
    }
  }
  ASSERT_EQ(poses[0].size(), poses[1].size());
  for (std::size_t i = 0; i < poses[0].size(); ++i) EXPECT_EQ(poses[0][i], poses[1][i]);
}

TEST(LoopFinderTest, WhatTheCameraStillFollowsIsNoCandidate) {
  LandmarkWorld world(6);
  LoopParams params;
  params.retrieval.exclude_recent = 3;
  LoopFinder finder(params, testCamera());
  for (std::uint32_t id = 1; id <= 10; ++id) {
    vision::Keyframe keyframe = world.seenFrom(onCircle(0.0), id);
    for (std::size_t i = 0; i < keyframe.corners.size(); ++i) keyframe.corners[i].landmark_id = i + 1;
    EXPECT_TRUE(finder.add(keyframe).empty());
  }
}

}  // namespace
}  // namespace stereo_nav::mapping
