#include "mapping/mono/one_point_ransac.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "mapping/mono/mono_landmarks.h"
#include "point_world.h"

namespace stereo_nav::mapping {
namespace {

/// A map of points, a camera that has moved otherwise than predicted, and matches of which the first ones are
/// wrong.
struct DisturbedView {
  DisturbedView(int wrong, unsigned seed) : state(kCameraRows + 3 * 40) {
    std::mt19937 random(seed);
    Matrix12d P = 1e-12 * Matrix12d::Identity();
    state.covariance.start(P);
    std::uniform_real_distribution<double> across(-1.0, 1.0), depth(2.0, 5.0);
    for (int i = 0; i < 40; ++i)
      addKnownPoint(state, {across(random), 0.7 * across(random), depth(random)}, 1e-3);
    predict(state, 0.04, {10.0, 20.0});
    CameraState truth = state.camera;
    truth.p_world = {0.02, 0.01, -0.01};
    truth.q_world_camera = expQuaternion({0.03, -0.04, 0.02});
    for (std::size_t i = 0; i < state.blocks.size(); ++i) {
      const auto expected = expectedPixel(model.camera, state.camera, state.blocks[i], 0.0);
      Eigen::Vector2d found = *pixelOf(model.camera, truth, state.blocks[i], 0.0);
      if (static_cast<int>(i) < wrong) found += 12.0 * test::noiseVector(1.0, random).head<2>().normalized();
      matches.push_back({i, *expected, found + test::noiseVector(0.1, random).head<2>()});
    }
  }
  MonoState state;
  ImageModel model{test::smallCamera(), 0.5, 0.0};
  std::vector<PixelMatch> matches;
};

TEST(OnePointRansac, WrongMatchesAreNamedAndRightOnesKept) {
  DisturbedView view(12, 5);
  std::mt19937 random(1);
  OnePointRansacParams params;
  params.threshold_px = 2.0;
  const auto inliers = lowInnovationInliers(view.state, view.model, view.matches, params, random);
  EXPECT_GE(inliers.size(), 15U);
  for (const std::size_t i : inliers) EXPECT_GE(i, 12U);
  std::vector<PixelMatch> agreeing;
  for (const std::size_t i : inliers) agreeing.push_back(view.matches[i]);
  ASSERT_TRUE(correctByPixels(view.state, agreeing, 0.5));
  EXPECT_LT((view.state.camera.p_world - Eigen::Vector3d(0.02, 0.01, -0.01)).norm(), 0.005);
  std::vector<PixelMatch> again;
  for (std::size_t i = 0; i < view.matches.size(); ++i) {
    if (std::find(inliers.begin(), inliers.end(), i) != inliers.end()) continue;
    again.push_back(view.matches[i]);
    again.back().expected =
        *expectedPixel(view.model.camera, view.state.camera, view.state.blocks[view.matches[i].block], 0.0);
  }
  const auto rescued = highInnovationInliers(view.state, view.model, again, params);
  EXPECT_EQ(rescued.size() + inliers.size(), 28U);
  for (const PixelMatch& match : rescued) EXPECT_GE(match.block, 12U);
}

TEST(OnePointRansac, TwoRunsWithTheSameSeedGiveTheSameMatches) {
  const DisturbedView view(15, 7);
  std::mt19937 first(3), second(3);
  EXPECT_EQ(lowInnovationInliers(view.state, view.model, view.matches, {}, first),
            lowInnovationInliers(view.state, view.model, view.matches, {}, second));
}

TEST(OnePointRansac, WithoutMatchesThereAreNoInliers) {
  DisturbedView view(0, 1);
  std::mt19937 random(1);
  EXPECT_TRUE(lowInnovationInliers(view.state, view.model, {}, {}, random).empty());
  EXPECT_TRUE(correctByPixels(view.state, {}, 0.5));
}

}  // namespace
}  // namespace stereo_nav::mapping
