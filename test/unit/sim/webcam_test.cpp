// The preset `webcam` as a whole: what its parts do to the images of a drive.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>

#include "sim/motion_smear.h"
#include "sim_test_support.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::sim {
namespace {

/// A webcam without noise before a plain wall, at rest for a second.
Scenario plainView() {
  Scenario scenario = cleanScenario();
  applyPreset(SensorPreset::kWebcam, scenario.sensor, scenario.left, scenario.right);
  scenario.sensor.read_noise = scenario.sensor.shot_noise = 0.0;
  scenario.sensor.processing = ProcessingParams();
  scenario.left = scenario.right = CameraResponse();
  ObjectParams wall = wallAhead(2.0, TextureKind::kPlain);
  wall.material.contrast = 0.0;
  scenario.scene.objects = {wall};
  scenario.path.front().duration_s = 1.0;
  return scenario;
}

double meanOf(const Simulation& simulation, std::size_t pair) {
  return cv::mean(simulation.image(Side::kLeft, pair))[0];
}

TEST(Webcam, ThePresetSetsDefaultsThatParametersChange) {
  const std::string arena = STEREO_NAV_SOURCE_DIR "/config/scenarios/arena.yaml";
  EXPECT_EQ(loadScenario(arena).sensor.read_noise, 3.0);
  EXPECT_EQ(loadScenario(arena).sensor.processing.jpeg_kb, 0.0);
  const Scenario webcam = loadScenario(arena, {"sensor.preset=webcam"});
  EXPECT_EQ(webcam.sensor.read_noise, 0.45);  // not the file's, which is for the other kind
  EXPECT_EQ(webcam.sensor.processing.jpeg_kb, 40.0);
  EXPECT_TRUE(webcam.sensor.auto_exposure.on);
  EXPECT_GT(webcam.left.speck.opacity, 0.0);
  const Scenario changed =
      loadScenario(arena, {"sensor.preset=webcam", "sensor.processing.jpeg_kb=20", "left.speck.opacity=0"});
  EXPECT_EQ(changed.sensor.processing.jpeg_kb, 20.0);
  EXPECT_EQ(changed.sensor.exposure_ms, 25.0);
  EXPECT_EQ(changed.left.speck.opacity, 0.0);
}

TEST(Webcam, AnUnknownPresetIsRefusedWithTheList) {
  try {
    loadScenario(STEREO_NAV_SOURCE_DIR "/config/scenarios/arena.yaml", {"sensor.preset=webcan"});
    FAIL() << "accepted";
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find("sensor.preset is 'webcan', allowed is one of: kind | webcam"),
              std::string::npos)
        << error.what();
  }
}

TEST(Webcam, SameSeedSameBytesInAnyOrderOnAnyThread) {
  const std::string file = STEREO_NAV_SOURCE_DIR "/config/scenarios/loop_webcam.yaml";
  const Scenario scenario = loadScenario(file, {"rig.image_scale=1", "timing.rate_hz=10"});
  const Simulation one(scenario, thesisRig(), 5), two(scenario, thesisRig(), 5);
  const cv::Mat late = one.image(Side::kRight, 60), early = one.image(Side::kRight, 20);
  auto concurrent = std::async(std::launch::async, [&] { return two.image(Side::kRight, 20); });
  EXPECT_EQ(cv::norm(two.image(Side::kRight, 60), late, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(concurrent.get(), early, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(Simulation(scenario, thesisRig(), 6).image(Side::kRight, 20), early, cv::NORM_INF), 0.0);
}

TEST(Webcam, ExposureHuntsWhenTheLampsGoOnAndSettlesWithinASecond) {
  Scenario scenario = plainView();
  scenario.sensor.flicker.mains_hz = 0.0;
  scenario.path.front().duration_s = 3.0;
  Event dim;  // until 1 s; the lamps take 0.2 s
  dim.from_s = 0.0;
  dim.to_s = 1.0;
  dim.level = 0.25;
  scenario.events = {dim};
  const Simulation simulation(scenario, thesisRig(), 1);
  const double before = meanOf(simulation, 20);
  double brightest = 0.0, darkest = 255.0;
  for (std::size_t pair = 28; pair < 60; ++pair) {
    brightest = std::max(brightest, meanOf(simulation, pair));
    darkest = std::min(darkest, meanOf(simulation, pair));
  }
  EXPECT_GT(brightest, 1.5 * before);
  EXPECT_LT(darkest, 0.9 * before);
  EXPECT_NEAR(meanOf(simulation, 75) / before, 1.0, 0.3);
  EXPECT_EQ(meanOf(simulation, 75), meanOf(simulation, 85));
  EXPECT_LT(
      simulation.exposure(Side::kLeft, 85).exposure_ms * simulation.exposure(Side::kLeft, 85).gain,
      0.5 * simulation.exposure(Side::kLeft, 20).exposure_ms * simulation.exposure(Side::kLeft, 20).gain);
}

TEST(Webcam, AWindowThatEntersTheViewDarkensTheRoom) {
  Scenario scenario = plainView();
  scenario.sensor.flicker.mains_hz = 0.0;
  ObjectParams window;  // to the left of the robot
  window.y_m = 3.0;
  window.length_m = 1.5;
  window.width_m = 0.1;
  window.height_m = 2.0;
  window.material.brightness = 10.0;
  window.material.contrast = 0.0;
  scenario.scene.objects.push_back(window);
  PathStep turn;
  turn.action = PathStep::Action::kTurn;
  turn.angle_deg = 90.0;
  PathStep wait = scenario.path.front();
  wait.duration_s = 2.0;
  scenario.path = {turn, wait};
  const Simulation simulation(scenario, thesisRig(), 1);
  const auto total = [&](std::size_t pair) {
    const ExposureSetting& setting = simulation.exposure(Side::kLeft, pair);
    return setting.exposure_ms * setting.gain;
  };
  const std::size_t last = simulation.pairs().size() - 1;
  EXPECT_LT(total(last), 0.2 * total(0)) << "ten times as bright as the wall, and in most of the view";
  for (std::size_t pair = 1; pair <= last; ++pair)
    EXPECT_LE(total(pair), total(pair - 1)) << "a white image does not say how far off it is: no overshoot";
}

TEST(Webcam, LampsDrawBandsAcrossARollingShutter) {
  Scenario scenario = plainView();
  scenario.sensor.auto_exposure.on = false;
  scenario.sensor.full_scale_ms = 0.0;
  scenario.sensor.vignetting = 0.0;
  scenario.sensor.exposure_ms = 4.0;
  scenario.sensor.rolling_shutter_ms = 30.0;
  scenario.sensor.flicker.depth = 0.3;
  const cv::Mat image = Simulation(scenario, thesisRig(), 1).image(Side::kLeft, 0);
  // Three periods of 10 ms in the readout of 240 rows: rows 80 apart are equal, rows 40 apart opposite.
  const double mean = 0.5 * 255.0 * 0.95, swing = 0.3 * std::sin(0.4 * M_PI) / (0.4 * M_PI);
  double low, high;
  cv::minMaxLoc(image.rowRange(0, 160), &low, &high);
  EXPECT_NEAR(high, mean * (1.0 + swing), 2.0);
  EXPECT_NEAR(low, mean * (1.0 - swing), 2.0);
  for (int row = 0; row < 80; ++row) {
    EXPECT_NEAR(image.at<uchar>(row, 160), image.at<uchar>(row + 80, 160), 1.0) << row;
    EXPECT_NEAR(image.at<uchar>(row, 160) + image.at<uchar>(row + 40, 160), 2.0 * mean, 2.0) << row;
  }
}

TEST(Webcam, ASpeckDarkensOnePlaceOfOneCamera) {
  Scenario scenario = plainView();
  scenario.sensor = SensorParams();
  scenario.sensor.read_noise = scenario.sensor.shot_noise = scenario.sensor.vignetting = 0.0;
  scenario.left.speck = {0.5, 0.25, 0.25, 0.05};  // at (80, 60), 16 px
  const Simulation simulation(scenario, thesisRig(), 1);
  const cv::Mat left = simulation.image(Side::kLeft, 0), right = simulation.image(Side::kRight, 0);
  EXPECT_NEAR(left.at<uchar>(60, 80), 0.5 * right.at<uchar>(60, 80), 2.0);
  const double share = 0.531;  // of the radius: 8.5 px
  EXPECT_NEAR(left.at<uchar>(60, 88),
              (1.0 - 0.5 * (1.0 - share * share * (3.0 - 2.0 * share))) * right.at<uchar>(60, 88), 1.5);
  EXPECT_EQ(left.at<uchar>(60, 97), right.at<uchar>(60, 97));
}

TEST(Webcam, TheAmplifierAmplifiesNoise) {
  SensorParams sensor;
  sensor.vignetting = 0.0;
  sensor.shot_noise = 0.2;
  const cv::Mat light(240, 320, CV_32FC1, cv::Scalar(25.0));
  const ImageSensor camera(320, 240, sensor, CameraResponse());
  cv::Scalar mean, deviation;
  cv::meanStdDev(camera.expose(light, 42, 4.0), mean, deviation);
  EXPECT_NEAR(mean[0], 100.0, 0.1);
  EXPECT_NEAR(deviation[0], std::sqrt(16.0 * (1.2 * 1.2 + 0.04 * 25.0) + 1.0 / 12.0), 0.1);
}

TEST(MotionSmear, APointBecomesALineOfTheMotion) {
  cv::Mat point = cv::Mat::zeros(41, 41, CV_32FC1);
  point.at<float>(20, 20) = 1.0f;
  const cv::Mat line = smeared(point, {8.0, 0.0});
  EXPECT_NEAR(cv::sum(line)[0], 1.0, 1e-5);
  for (int x = 17; x <= 23; ++x) EXPECT_NEAR(line.at<float>(20, x), 1.0 / 8.0, 0.005) << x;
  EXPECT_NEAR(line.at<float>(20, 16), 0.5 / 8.0, 0.005);
  EXPECT_NEAR(line.at<float>(20, 15), 0.0, 0.005);
  EXPECT_EQ(line.at<float>(21, 20), 0.0f);
  const cv::Mat slanted = smeared(point, {-5.0, 3.0});
  EXPECT_NEAR(cv::sum(slanted)[0], 1.0, 1e-5);
  EXPECT_GT(slanted.at<float>(21, 18), 0.02f);
  EXPECT_LT(slanted.at<float>(19, 18), 0.01f);
}

TEST(MotionSmear, ATurnMovesTheImage) {
  const CameraCalibration camera = thesisRig().left;
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitY()).toRotationMatrix();
  // The camera turns to the right, about its y axis that points down: the image moves to the left.
  const Eigen::Vector2d step_px = turnedBy(camera, Eigen::Matrix3d::Identity(), turned);
  EXPECT_NEAR(step_px.x(), -std::tan(0.01) * camera.K(0, 0), 1e-9);
  EXPECT_NEAR(step_px.y(), 0.0, 1e-9);
}

TEST(MotionSmear, FillsTheGapsBetweenTheRaysOfAnExposure) {
  Scenario scenario = edgeScenario();
  scenario.sensor.exposure_ms = 60.0;  // 26 px in four steps
  const auto largestStep = [&] {
    const Simulation simulation(scenario, thesisRig(), 1);
    const cv::Mat image = simulation.image(Side::kLeft, simulation.pairs().size() / 2);
    int largest = 0;
    for (int x = 20; x < 300; ++x) {
      largest = std::max(largest, std::abs(image.at<uchar>(110, x) - image.at<uchar>(110, x - 1)));
    }
    return largest;
  };
  EXPECT_GT(largestStep(), 25);
  scenario.sensor.smooth_motion_blur = true;
  EXPECT_LT(largestStep(), 12);  // 173 grey levels over 26 px are 7
}

}  // namespace
}  // namespace stereo_nav::sim
