// The arena is as the thesis describes it: much of what can be tracked is far away, and near features are
// missing at way-points 7 and 12.
#include <gtest/gtest.h>

#include <algorithm>

#include "sim_test_support.h"
#include "vision/corner_detector.h"

namespace stereo_nav::sim {
namespace {

/// Depths (along the view) of the corners that the odometry would track in a left image.
std::vector<double> featureDepths(const Simulation& simulation, const Scene& scene, std::size_t pair) {
  const CameraCalibration& camera = simulation.calibration(Side::kLeft);
  const double time_s = simulation.imageTime(Side::kLeft, pair);
  const Eigen::Isometry3d T =
      simulation.trajectory().pose(time_s) * simulation.scenario().rig.T_base_camera();
  std::vector<double> depths;
  const cv::Mat image = rectify(camera, simulation.image(Side::kLeft, pair));
  for (const cv::Point2f& corner : vision::CornerDetector(vision::CornerDetectorParams()).detect(image)) {
    const Eigen::Vector3d ray((corner.x - camera.P(0, 2)) / camera.P(0, 0),
                              (corner.y - camera.P(1, 2)) / camera.P(1, 1), 1.0);
    depths.push_back(scene.castRay(T.translation(), T.linear() * ray, time_s));
  }
  return depths;
}

class Arena : public testing::Test {
 protected:
  Arena()
      : simulation_(loadScenario(STEREO_NAV_SOURCE_DIR "/config/scenarios/arena.yaml"), thesisRig(), 1),
        scene_(simulation_.scenario().scene) {}

  static double share(const std::vector<double>& depths, double from_m, double to_m) {
    const auto inside =
        std::count_if(depths.begin(), depths.end(), [&](double d) { return d >= from_m && d < to_m; });
    return static_cast<double>(inside) / static_cast<double>(depths.size());
  }

  std::vector<double> atWaypoint(std::size_t number) {
    const double time_s = simulation_.trajectory().waypoints()[number - 1].time_s;
    return featureDepths(simulation_, scene_, static_cast<std::size_t>(time_s * 30.0));
  }

  Simulation simulation_;
  Scene scene_;
};

TEST_F(Arena, ManyFeaturesAreFarAndEveryImageHasFeatures) {
  std::vector<double> all;
  for (std::size_t pair = 0; pair < simulation_.pairs().size(); pair += 30) {
    const std::vector<double> depths = featureDepths(simulation_, scene_, pair);
    EXPECT_GE(depths.size(), 25u) << pair;
    all.insert(all.end(), depths.begin(), depths.end());
  }
  EXPECT_GE(share(all, 6.0, 100.0), 0.40);
  EXPECT_LE(share(all, 6.0, 100.0), 0.60);
}

TEST_F(Arena, NearFeaturesAreMissingAtWaypoints7And12) {
  EXPECT_GT(share(atWaypoint(3), 0.0, 3.0), 0.20);
  EXPECT_LT(share(atWaypoint(7), 0.0, 3.0), 0.10);
  EXPECT_LT(share(atWaypoint(12), 0.0, 3.0), 0.10);
}

}  // namespace
}  // namespace stereo_nav::sim
