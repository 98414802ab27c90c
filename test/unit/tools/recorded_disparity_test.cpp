// The disparity maps that true_disparity writes, read back as evaluate does.
#include "tools/evaluate/recorded_disparity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/simulation.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/recording.h"
#include "support/command.h"

namespace stereo_nav::tools {
namespace {

const std::string kScenario = STEREO_NAV_SOURCE_DIR "/config/scenarios/arena.yaml";
constexpr double kStart_s = 1e9;

std::string trueDisparity(const std::string& name, const std::string& options) {
  const std::string path = testing::TempDir() + name;
  const auto result =
      test::runCommand("ROS_PACKAGE_PATH=" STEREO_NAV_SOURCE_DIR " " TRUE_DISPARITY " " + kScenario +
                       " --output " + path + " --set timing.rate_hz=0.5 " + options);
  EXPECT_EQ(result.status, 0) << result.output;
  return path;
}

TEST(RecordedDisparity, IsTheTruthExactOrInSteps) {
  RecordedDisparity exact(trueDisparity("exact.bag", "")),
      steps(trueDisparity("steps.bag", "--step-px 0.0625"));
  const sim::Simulation simulation(sim::loadScenario(kScenario, {"timing.rate_hz=0.5"}),
                                   sim::loadStereoCalibration(STEREO_NAV_SOURCE_DIR "/config/thesis"), 1);
  const sim::Scene scene(simulation.scenario().scene);
  const auto& P = simulation.calibration(sim::Side::kLeft).P;
  for (const double time_s : {0.0, 6.0, 20.0}) {
    const cv::Mat map = exact.at(kStart_s + time_s), stepped = steps.at(kStart_s + time_s);
    ASSERT_EQ(map.size(), cv::Size(320, 240)) << time_s;
    const Eigen::Isometry3d T =
        simulation.trajectory().pose(time_s) * simulation.scenario().rig.T_base_camera();
    for (const cv::Point pixel : {cv::Point(0, 0), cv::Point(142, 117), cv::Point(250, 230)}) {
      const Eigen::Vector3d ray((pixel.x - P(0, 2)) / P(0, 0), (pixel.y - P(1, 2)) / P(1, 1), 1.0);
      const double disparity_px = P(0, 0) * 0.1226 / scene.castRay(T.translation(), T.linear() * ray, time_s);
      EXPECT_NEAR(map.at<float>(pixel), disparity_px, 1e-4 * disparity_px);
      EXPECT_EQ(stepped.at<float>(pixel), std::round(16.0f * map.at<float>(pixel)) / 16.0f);
    }
  }
}

TEST(RecordedDisparity, WhatIsNotThereIsEmptyOrRefused) {
  RecordedDisparity exact(trueDisparity("gaps.bag", ""));
  EXPECT_TRUE(exact.at(kStart_s + 1.0).empty());  // a map every two seconds
  EXPECT_FALSE(exact.at(kStart_s + 2.0).empty());
  EXPECT_TRUE(exact.at(kStart_s + 1000.0).empty());
  EXPECT_THROW(RecordedDisparity(STEREO_NAV_SOURCE_DIR "/bags/arena_start.bag"), InputError);
  EXPECT_THROW(RecordedDisparity("/nowhere.bag"), InputError);
  const auto result =
      test::runCommand("ROS_PACKAGE_PATH=" STEREO_NAV_SOURCE_DIR " " TRUE_DISPARITY " " + kScenario +
                       " --output " + testing::TempDir() + "skew.bag --set timing.time_offset_ms=5");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.output.find("at the same time"), std::string::npos) << result.output;
}

}  // namespace
}  // namespace stereo_nav::tools
