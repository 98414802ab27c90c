#include "mapping/loop/loop_finder.h"

#include <gtest/gtest.h>

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
    keyframe.follows = count_ > 0;
    if (keyframe.follows) {
      keyframe.T_previous_keyframe = before_.inverse() * T_world_camera * expMotion(drift);
      keyframe.covariance = 1e-6 * Matrix6d::Identity();
    }
    before_ = T_world_camera;
    ++count_;
    return finder_.add(keyframe);
  }

  const LoopFinder& finder() const { return finder_; }
  std::uint32_t count() const { return count_; }

 private:
  LoopFinder finder_;
  Eigen::Isometry3d before_ = Eigen::Isometry3d::Identity();
  std::uint32_t count_ = 0;
};

TEST(LoopFinderTest, KnowsTheSecondLapAndWhereItIs) {
  LandmarkWorld world(1);
  Drive drive;
  for (int i = 0; i < kLap; ++i) {
    for (const LoopCandidate& candidate : drive.step(world)) EXPECT_FALSE(candidate.accepted());
  }
  int recognised = 0;
  double nees = 0.0;
  for (int i = 0; i < 10; ++i) {
    const auto candidates = drive.step(world);
    ASSERT_FALSE(candidates.empty());
    const LoopCandidate& best = candidates.front();
    EXPECT_NEAR(static_cast<double>(best.place), i, 2.0);
    EXPECT_EQ(best.stage == LoopStage::kConsistency, i == 0) << "nothing before the first says the same";
    if (!best.accepted()) continue;
    ++recognised;
    const Eigen::Isometry3d T_true = onCircle(static_cast<double>(best.place) / kLap).inverse() *
                                     onCircle(static_cast<double>(best.query) / kLap);
    const Vector6d error = logMotion(best.place_query.T.inverse() * T_true);
    EXPECT_LT(error.head<3>().norm(), 0.02);
    EXPECT_LT(error.tail<3>().norm(), 0.005);
    nees += error.dot(best.place_query.covariance.ldlt().solve(error));
  }
  EXPECT_GE(recognised, 8);
  EXPECT_LT(nees / recognised, 12.0);
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
