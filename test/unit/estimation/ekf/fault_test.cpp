#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fusion_scene.h"

namespace stereo_nav::estimation::test {
namespace {

constexpr double kBegin_s = 1020.0;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// What the errors grow by in five seconds at most: without a fault (largest of 20 seeds), and after one.
constexpr double kUndisturbed_m = 0.031, kUndisturbed_rad = 0.011;
constexpr double kGrowth_m = 0.06, kGrowth_rad = 0.02;

/// What a fault must not do, whichever it is.
struct Harm {
  double largest_step_m = 0.0;  ///< of the estimate beyond the true motion, between two samples
  double largest_nees = 0.0;
  double growth_m = 0.0;  ///< of the error, in the five seconds from one second after the fault on
  double growth_rad = 0.0;
  bool finite = true;
};

Harm harmOf(const SceneResult& result, double end_s) {
  Harm harm;
  const SceneSample* begin = nullptr;
  for (std::size_t i = 1; i < result.samples.size(); ++i) {
    const SceneSample& sample = result.samples[i];
    const SceneSample& before = result.samples[i - 1];
    harm.finite = harm.finite && sample.error.allFinite() && sample.estimate.pose_covariance.allFinite() &&
                  sample.estimate.twist.allFinite();
    if (sample.time_s < kBegin_s - 1000.0 || sample.time_s > end_s - 1000.0 + 6.0) continue;
    harm.largest_step_m = std::max(harm.largest_step_m, (sample.error - before.error).head<2>().norm());
    harm.largest_nees = std::max(harm.largest_nees, sample.nees);
    if (begin == nullptr && sample.time_s >= end_s - 1000.0 + 1.0) begin = &sample;
    if (begin == nullptr || sample.time_s > begin->time_s + 5.0) continue;
    // The error of the pose relative to that of then: a turned start turns the way.
    const Eigen::Isometry2d T_true = begin->T_true.inverse() * sample.T_true;
    const Eigen::Isometry2d T_estimated =
        planarPart(begin->estimate.T_world_base.inverse() * sample.estimate.T_world_base);
    const Eigen::Isometry2d error = T_true.inverse() * T_estimated;
    harm.growth_m = std::max(harm.growth_m, error.translation().norm());
    harm.growth_rad = std::max(harm.growth_rad, std::abs(logPlanar(error)[2]));
  }
  return harm;
}

class FusionFault : public testing::Test {
 protected:
  /// A fault of one channel from kBegin_s for `duration_s`.
  using Change = std::function<bool(Measurement&, double&)>;
  SceneResult with(int channel, double duration_s, const Change& change) {
    end_s_ = kBegin_s + duration_s;
    // As long as harmOf() looks.
    options_.duration_s = std::min(60.0, end_s_ - 1000.0 + 6.5);
    options_.fault = [=](Measurement& measurement, double& received_s) {
      const bool now = measurement.time_s >= kBegin_s && measurement.time_s < kBegin_s + duration_s;
      return !now || (channel >= 0 && measurement.channel != channel) || change(measurement, received_s);
    };
    return runScene(options_);
  }

  void expectHarmless(const SceneResult& result) const {
    const Harm harm = harmOf(result, end_s_);
    EXPECT_TRUE(harm.finite);
    EXPECT_LE(harm.largest_step_m, 0.05);
    EXPECT_LE(harm.largest_nees, kNees9973);
    EXPECT_LE(harm.growth_m, kGrowth_m);
    EXPECT_LE(harm.growth_rad, kGrowth_rad);
  }

  static bool said(const SceneResult& result, const std::string& text) {
    return std::any_of(result.announcements.begin(), result.announcements.end(),
                       [&](const std::string& one) { return one.find(text) != std::string::npos; });
  }

  SceneOptions options_;
  double end_s_ = 0.0;
};

TEST_F(FusionFault, NoneSaysNothing) {
  const SceneResult result = with(-1, 0.0, [](Measurement&, double&) { return true; });
  expectHarmless(result);
  EXPECT_TRUE(result.announcements.empty()) << result.announcements.front();
}

TEST_F(FusionFault, WithoutOneTheErrorsGrowByWhatIsStated) {
  double largest_m = 0.0, largest_rad = 0.0;
  for (options_.seed = 1; options_.seed <= 20; ++options_.seed) {
    const SceneResult result = with(-1, 0.0, [](Measurement&, double&) { return true; });
    const Harm harm = harmOf(result, end_s_);
    largest_m = std::max(largest_m, harm.growth_m);
    largest_rad = std::max(largest_rad, harm.growth_rad);
  }
  EXPECT_NEAR(largest_m, kUndisturbed_m, 0.002);
  EXPECT_NEAR(largest_rad, kUndisturbed_rad, 0.001);
}

TEST_F(FusionFault, ValuesThatAreNoNumbers) {
  for (const double bad : {kNaN, kInfinity, 1e308}) {
    const SceneResult result = with(channel::kGyro, 5.0, [bad](Measurement& m, double&) {
      m.value[5] = bad;
      return true;
    });
    expectHarmless(result);
    EXPECT_TRUE(said(result, "gyroscope: vyaw is"));
  }
}

TEST_F(FusionFault, VariancesThatCannotBeRight) {
  for (const double bad : {kNaN, kInfinity, 0.0, 1e308, -0.5}) {
    for (const int channel : {channel::kGyro, channel::kLaser, channel::kWheels}) {
      const SceneResult result = with(channel, 5.0, [bad](Measurement& m, double&) {
        m.covariance.setConstant(bad);
        return true;
      });
      expectHarmless(result);
      EXPECT_TRUE(said(result, "variance of")) << bad << " of " << channel;
    }
  }
}

TEST_F(FusionFault, EachThingIsSaidOnce) {
  const SceneResult result = with(channel::kGyro, 5.0, [](Measurement& m, double&) {
    m.covariance.setZero();
    return true;
  });
  EXPECT_EQ(result.announcements.size(), 1u);
}

TEST_F(FusionFault, SilenceOfOneSensor) {
  for (const int channel : {channel::kWheels, channel::kGyro, channel::kLaser, channel::kStereo}) {
    for (const double gap_s : {1.0, 10.0})
      expectHarmless(with(channel, gap_s, [](Measurement&, double&) { return false; }));
  }
}

TEST_F(FusionFault, SilenceOfAllStaysInsideTheEllipsoid) {
  const SceneResult result = with(-1, 1.0, [](Measurement&, double&) { return false; });
  const Harm harm = harmOf(result, end_s_);
  EXPECT_TRUE(harm.finite);
  EXPECT_LE(harm.largest_nees, kNees9973);
  EXPECT_LE(harm.growth_m, kGrowth_m);
}

TEST_F(FusionFault, MessagesThatComeLateArePutWhereTheyBelong) {
  const auto late = [](Measurement&, double& received_s) {
    received_s += 0.3;
    return true;
  };
  for (const int channel : {channel::kLaser, channel::kWheels, channel::kGyro}) {
    const SceneResult result = with(channel, 5.0, late);
    expectHarmless(result);
    EXPECT_GT(result.statistics[static_cast<std::size_t>(channel)].rewound, 10u);
  }
}

TEST_F(FusionFault, ClockSetBack) {
  options_.clock_back_at_s = kBegin_s - 1000.0;
  const SceneResult result = with(-1, 0.0, [](Measurement&, double&) { return true; });
  EXPECT_TRUE(said(result, "the clock was set back by 10.0 s"));
  expectHarmless(result);
}

TEST_F(FusionFault, StampsOfOneSensorSetBack) {
  const SceneResult result = with(channel::kWheels, 5.0, [](Measurement& m, double&) {
    m.time_s -= 10.0;
    return true;
  });
  expectHarmless(result);
  EXPECT_TRUE(said(result, "wheels: a measurement came 10.0"));
}

TEST_F(FusionFault, WheelsSlip) {
  const SceneResult result = with(channel::kWheels, 2.0, [](Measurement& m, double&) {
    m.value.head<2>() *= 1.3;
    return true;
  });
  expectHarmless(result);
  EXPECT_TRUE(said(result, "wheels is outvoted") || said(result, "wheels disagrees"));
}

TEST_F(FusionFault, WheelsSlipWithLaserAlone) {
  options_.stereo = false;
  const SceneResult result = with(channel::kWheels, 2.0, [](Measurement& m, double&) {
    m.value.head<2>() *= 1.3;
    return true;
  });
  const Harm harm = harmOf(result, end_s_);
  EXPECT_TRUE(harm.finite);
  EXPECT_LE(harm.largest_step_m, 0.05);
  EXPECT_LE(harm.growth_m, kGrowth_m);
  EXPECT_TRUE(said(result, "wheels and laser disagree about vx"));
  // Expected to fail: two alone cannot tell who is right, and until the vote, 0.4 s, the covariance does not
  // know of the doubt. Should be 14.16 at most; where it is, this mark goes.
  EXPECT_GT(harm.largest_nees, kNees9973);
  EXPECT_LT(harm.largest_nees, 2.0 * kNees9973);
}

TEST_F(FusionFault, LaserIsCovered) {
  Eigen::Isometry3d held = Eigen::Isometry3d::Identity();
  const SceneResult result = with(channel::kLaser, 3.0, [&held](Measurement& m, double&) {
    if (m.time_s < kBegin_s + 0.05) held = m.pose;
    m.pose = held;
    return true;
  });
  expectHarmless(result);
  EXPECT_TRUE(said(result, "laser is outvoted") || said(result, "laser disagrees"));
}

TEST_F(FusionFault, StereoIsLostAndComesBackElsewhere) {
  const SceneResult result = with(channel::kStereo, 3.0, [](Measurement& m, double&) {
    m.covariance = Matrix6d::Identity() * 1e6;
    m.pose.setIdentity();
    return true;
  });
  expectHarmless(result);
  EXPECT_TRUE(said(result, "stereo: says of all that it measures that it does not know it"));
}

TEST_F(FusionFault, GyroscopeReversed) {
  const SceneResult result = with(channel::kGyro, 5.0, [](Measurement& m, double&) {
    m.value[5] = -m.value[5];
    return true;
  });
  expectHarmless(result);
  EXPECT_TRUE(said(result, "gyroscope is outvoted"));
}

TEST_F(FusionFault, PositionsJump) {
  options_.gnss = true;
  const SceneResult result = with(channel::kGnss, 10.0, [](Measurement& m, double&) {
    m.pose.translation().x() += 20.0;
    return true;
  });
  expectHarmless(result);
  EXPECT_TRUE(said(result, "gnss disagrees"));
}

}  // namespace
}  // namespace stereo_nav::estimation::test
