#include <gtest/gtest.h>

#include "fusion_scene.h"

namespace stereo_nav::estimation::test {
namespace {

struct Consistency {
  double mean = 0.0;
  double inside_95 = 0.0;
  double rmse_m = 0.0;
  double rmse_rad = 0.0;
};

/// Over several runs, at instants that lie seconds apart.
Consistency consistencyOf(
    SceneOptions options, unsigned runs,
    const std::function<void(SceneOptions&)>& vary = [](SceneOptions&) {}) {
  Consistency sum;
  options.sample_period_s = 5.0;
  int count = 0;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    options.seed = seed;
    vary(options);
    const SceneResult result = runScene(options);
    for (const SceneSample& sample : result.samples) {
      if (sample.time_s < 10.0) continue;
      sum.mean += sample.nees;
      sum.inside_95 += sample.nees < kNees95 ? 1.0 : 0.0;
      sum.rmse_m += sample.error.head<2>().squaredNorm();
      sum.rmse_rad += sample.error[2] * sample.error[2];
      ++count;
    }
  }
  return {sum.mean / count, sum.inside_95 / count, std::sqrt(sum.rmse_m / count),
          std::sqrt(sum.rmse_rad / count)};
}

TEST(FusionConsistency, CovariancesAreAsLargeAsTheErrors) {
  SceneOptions options;
  const Consistency consistency = consistencyOf(options, 30);
  EXPECT_GT(consistency.mean, 2.0);
  EXPECT_LT(consistency.mean, 4.5);
  EXPECT_GT(consistency.inside_95, 0.85);
}

TEST(FusionConsistency, WithWheelsAndGyroscopeAndLaserAlone) {
  SceneOptions options;
  options.stereo = false;
  const Consistency consistency = consistencyOf(options, 30);
  EXPECT_GT(consistency.mean, 2.0);
  EXPECT_LT(consistency.mean, 4.5);
  EXPECT_GT(consistency.inside_95, 0.85);
}

TEST(FusionConsistency, WithWheelsOfUnknownScaleAndGyroscopeAlone) {
  SceneOptions options;
  options.laser = options.stereo = false;
  const Consistency consistency = consistencyOf(options, 60, [](SceneOptions& scene) {
    std::mt19937 random(1000 + scene.seed);
    std::normal_distribution<double> scale(0.0, FilterParams().wheel_scale_sigma);
    for (int axis = 0; axis < 3; ++axis) scene.wheel_scale[axis] = scale(random);
  });
  EXPECT_GT(consistency.mean, 1.5);
  EXPECT_LT(consistency.mean, 5.0);
  EXPECT_GT(consistency.inside_95, 0.85);
}

TEST(FusionConsistency, WheelsOfUnequalRadiiBesideALaserWithoutAGyroscope) {
  SceneOptions options;
  options.gyro = options.stereo = false;
  const Consistency consistency = consistencyOf(options, 30, [](SceneOptions& scene) {
    std::mt19937 random(1000 + scene.seed);
    scene.wheel_turn_per_way_rad_m = std::normal_distribution<double>(0.0, 0.05)(random);
  });
  EXPECT_GT(consistency.mean, 1.5);
  EXPECT_LT(consistency.mean, 5.0);
  EXPECT_GT(consistency.inside_95, 0.85);
  EXPECT_LT(consistency.rmse_m, 0.1);
}

TEST(FusionConsistency, PositionsFromOutsideKeepTheErrorBounded) {
  SceneOptions options;
  options.gnss = true;
  const Consistency consistency = consistencyOf(options, 10);
  EXPECT_GT(consistency.mean, 1.5);
  EXPECT_LT(consistency.mean, 5.0);
}

}  // namespace
}  // namespace stereo_nav::estimation::test
