#include "sim/renderer.h"

#include <gtest/gtest.h>

#include <future>

#include "sim_test_support.h"

namespace stereo_nav::sim {
namespace {

/// Squares of kChecker with its default texels.
constexpr double kSquare_m = 32 * 0.004;

/// Checker corners of a wall ahead whose pixels lie well inside the image: (raw pixel as computed, as found).
std::vector<std::pair<Eigen::Vector2d, cv::Point2f>> findCorners(const Simulation& simulation, Side side,
                                                                 const ObjectParams& wall) {
  const CameraCalibration& camera = simulation.calibration(side);
  const cv::Mat image = simulation.image(side, 0);
  const Eigen::Isometry3d T_camera_world =
      simulation.cameraPose(side, simulation.imageTime(side, 0)).inverse();
  std::vector<std::pair<Eigen::Vector2d, cv::Point2f>> corners;
  for (int column = -20; column <= 20; ++column) {
    for (int row = -15; row <= 0; ++row) {
      const Eigen::Vector3d corner_world(wall.x_m - 0.5 * wall.length_m, wall.y_m + column * kSquare_m,
                                         0.5 * wall.height_m + row * kSquare_m);
      const Eigen::Vector3d p = T_camera_world * corner_world;
      const Eigen::Vector2d pixel = camera.distort({p.x() / p.z(), p.y() / p.z()});
      if (pixel.x() < 15 || pixel.x() > camera.width - 15 || pixel.y() < 15 || pixel.y() > camera.height - 15)
        continue;
      std::vector<cv::Point2f> found{
          {static_cast<float>(std::round(pixel.x())), static_cast<float>(std::round(pixel.y()))}};
      cv::cornerSubPix(image, found, {5, 5}, {-1, -1},
                       {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 50, 1e-4});
      corners.emplace_back(pixel, found[0]);
    }
  }
  return corners;
}

/// cornerSubPix has no bias on symmetric crossings, but scatters by up to 0.1 px where squares are small:
/// hence the large squares.
TEST(Renderer, KnownPointsAppearWhereTheCalibrationPutsThem) {
  for (const auto& [image_scale, distance_m] :
       {std::pair<int, double>{1, 1.5}, {2, 1.5}, {2, 2.5}, {4, 4.0}}) {
    Scenario scenario = cleanScenario();
    const ObjectParams wall = wallAhead(distance_m, TextureKind::kChecker);
    scenario.scene.objects = {wall};
    scenario.rig.samples_per_pixel = 16;
    scenario.rig.image_scale = image_scale;
    const Simulation simulation(scenario, thesisRig(), 1);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const auto corners = findCorners(simulation, side, wall);
      ASSERT_GE(corners.size(), 25u);
      Eigen::Vector2d mean = Eigen::Vector2d::Zero();
      for (const auto& [expected, found] : corners) {
        const Eigen::Vector2d error = Eigen::Vector2d(found.x, found.y) - expected;
        EXPECT_LT(error.norm(), 0.1) << distance_m << " m, at " << expected.transpose();
        mean += error / static_cast<double>(corners.size());
      }
      EXPECT_LT(mean.norm(), 0.02) << distance_m << " m";
    }
  }
}

TEST(Renderer, ATextureOfOneValueGivesItsGreyLevelEverywhere) {
  Scenario scenario = cleanScenario();
  ObjectParams wall = wallAhead(2.0, TextureKind::kClutter);
  wall.material.contrast = 0.0;
  wall.material.brightness = 0.4;
  scenario.scene.objects = {wall};
  const cv::Mat image =
      Simulation(scenario, thesisRig(), 1).image(Side::kLeft, 0).rowRange(0, 160);  // above the floor
  double low, high;
  cv::minMaxLoc(image, &low, &high);
  EXPECT_EQ(low, high);
  EXPECT_NEAR(low, 0.4 * 255.0 * 0.95, 1.0);  // sides that face this way get 95 % of the light
}

/// Column where the grey level passes the middle between the two sides of a vertical edge.
double edgeColumn(const cv::Mat& image, int row) {
  const double left = image.at<uchar>(row, 2), right = image.at<uchar>(row, image.cols - 3),
               middle = 0.5 * (left + right);
  for (int x = 1; x < image.cols; ++x) {
    const double before = image.at<uchar>(row, x - 1), after = image.at<uchar>(row, x);
    if ((before - middle) * (after - middle) <= 0.0 && before != after)
      return x - 1 + (middle - before) / (after - before);
  }
  return -1.0;
}

TEST(Renderer, MotionBlursOverTheExposureAroundItsMiddle) {
  Scenario scenario = edgeScenario();
  scenario.rig.samples_per_pixel = 16;
  const Simulation sharp(scenario, thesisRig(), 1);
  scenario.sensor.exposure_ms = 30.0;
  const Simulation blurred(scenario, thesisRig(), 1);
  // In the middle of the turn the robot turns at 60 deg/s: 0.0314 rad in 30 ms, about 13 px.
  const std::size_t pair = sharp.pairs().size() / 2;
  const cv::Mat a = sharp.image(Side::kLeft, pair), b = blurred.image(Side::kLeft, pair);
  const int row = 110;
  int changing = 0;
  for (int x = 1; x < b.cols; ++x) changing += b.at<uchar>(row, x) != b.at<uchar>(row, x - 1) ? 1 : 0;
  EXPECT_GE(changing, 11);
  EXPECT_LE(changing, 17);
  EXPECT_NEAR(edgeColumn(a, row), edgeColumn(b, row), 0.6);
}

TEST(Renderer, ARollingShutterShearsByTheMotionDuringTheReadout) {
  Scenario scenario = edgeScenario();
  const Simulation global(scenario, thesisRig(), 1);
  scenario.sensor.rolling_shutter_ms = 25.0;
  const Simulation rolling(scenario, thesisRig(), 1);
  const std::size_t pair = global.pairs().size() / 2;
  const cv::Mat a = global.image(Side::kLeft, pair), b = rolling.image(Side::kLeft, pair);
  const auto shift = [&](int row) { return edgeColumn(b, row) - edgeColumn(a, row); };
  // 60 deg/s * 25 ms = 1.5 deg = 10.9 px at f = 417 from the first row to the last one.
  EXPECT_NEAR(shift(150) - shift(10), 10.9 * 140.0 / 240.0, 1.0);
  EXPECT_NEAR(shift(119), 0.0, 0.6);
}

TEST(Renderer, ImagesDoNotDependOnTheThread) {
  Scenario scenario = cleanScenario();
  scenario.sensor = SensorParams();
  scenario.scene.objects = {wallAhead(2.0, TextureKind::kClutter)};
  const Simulation one(scenario, thesisRig(), 5), two(scenario, thesisRig(), 5),
      other(scenario, thesisRig(), 6);
  const cv::Mat later_first = one.image(Side::kRight, 2);
  const cv::Mat alone = one.image(Side::kRight, 0);
  auto concurrent = std::async(std::launch::async, [&] { return two.image(Side::kRight, 2); });
  const cv::Mat meanwhile = two.image(Side::kRight, 0);
  EXPECT_EQ(cv::norm(meanwhile, alone, cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(concurrent.get(), later_first, cv::NORM_INF), 0.0);
  EXPECT_NE(cv::norm(other.image(Side::kRight, 0), alone, cv::NORM_INF), 0.0);
}

TEST(Renderer, WalkersMoveAndCylindersAreRound) {
  Scenario scenario = cleanScenario();
  ObjectParams pole;
  pole.shape = Shape::kCylinder;
  pole.x_m = 3.0;
  pole.length_m = 0.4;
  pole.height_m = 2.0;
  pole.walk_y_m = 1.0;
  pole.walk_period_s = 4.0;
  scenario.scene.objects = {pole};
  const Scene scene(scenario.scene);
  const Eigen::Vector3d origin(0.0, 0.0, 0.3), forward(1.0, 0.0, 0.0);
  EXPECT_NEAR(scene.castRay(origin, forward, 0.0), 2.8, 1e-7);
  EXPECT_NEAR(scene.castRay(origin, forward, -0.006), 2.8, 1e-4) << "the first exposure begins before 0";
  EXPECT_NEAR(scene.castRay(origin + Eigen::Vector3d(0, 0.1, 0), forward, 0.0), 3.0 - std::sqrt(0.04 - 0.01),
              1e-7);
  EXPECT_GT(scene.castRay(origin, forward, 2.0), 10.0);  // it is 1 m to the left now
  EXPECT_NEAR(scene.castRay(origin + Eigen::Vector3d(0, 1.0, 0), forward, 2.0), 2.8, 1e-7);
}

TEST(Renderer, AnImpossibleNumberOfSamplesIsRefused) {
  EXPECT_THROW(Renderer(thesisRig().left, 0), std::invalid_argument);
}

}  // namespace
}  // namespace stereo_nav::sim
