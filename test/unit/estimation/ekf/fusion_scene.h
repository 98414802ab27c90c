#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "core/planar_motion.h"
#include "estimation/ekf/fusion_filter.h"

namespace stereo_nav::estimation::test {

/// A sensor that may be at fault at some time: changes a measurement, or returns false to have it lost.
using Fault = std::function<bool(Measurement&, double& received_s)>;

struct SceneOptions {
  unsigned seed = 1;
  double duration_s = 60.0;
  double sample_period_s = 0.02;  ///< a multiple of 0.01 s
  bool laser = true;
  bool stereo = true;  ///< a second odometry, beside the laser
  bool gyro = true;
  bool gnss = false;  ///< absolute positions at 5 Hz, sigma 0.3 m
  double gyro_bias_rad_s = 0.0026;
  Eigen::Vector3d wheel_scale{0.02, -0.07, 0.05};
  double wheel_turn_per_way_rad_m = 0.0;  ///< that the wheels do not show, as those of unequal radii
  double clock_back_at_s =
      std::numeric_limits<double>::infinity();  ///< then the clock of all is set back by 10 s
  Fault fault;                                  ///< asked for each measurement
};

/// Channels of the scene.
namespace channel {
constexpr int kWheels = 0;
constexpr int kGyro = 1;
constexpr int kLaser = 2;
constexpr int kStereo = 3;
constexpr int kGnss = 4;
}  // namespace channel

/// What the filter said at an instant, and the truth.
struct SceneSample {
  double time_s;
  Eigen::Isometry2d T_true;
  FusedEstimate estimate;
  Eigen::Vector3d error;  ///< x, y, yaw; axes of the world
  double nees;            ///< of the three
};

struct SceneResult {
  std::vector<SceneSample> samples;  ///< one each sample_period_s
  std::vector<std::string> announcements;
  std::vector<ChannelStatistics> statistics;
};

/// A robot of omnidirectional wheels on a smooth course of exact truth: wheels at 50 Hz, a gyroscope at 100
/// Hz, a laser's and a stereo camera's odometry at 10 Hz, noise as stated by each.
SceneResult runScene(const SceneOptions& options);

/// A filter as the scene has it.
FusionFilter sceneFilter(const SceneOptions& options);

/// Sum of the squares of three normal numbers.
constexpr double kNees95 = 7.815;
constexpr double kNees9973 = 14.16;

}  // namespace stereo_nav::estimation::test
