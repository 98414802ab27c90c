// Which features moved with the scene? Four ways to tell, on the same noisy scenes of known answer:
//   taskset -c 1 build/devel/lib/stereo_nav/rigidity_bench_test
// exact: the largest clique of the rigidity graph; greedy: the one grown as in the thesis; star: the node
// with most neighbours and these; ransac: the motion of three pairs with most agreement by reprojection (200
// drawn). recall: share of the static features that are found; wrong: share of the chosen ones that are not
// static; motion_mm: error of the translation from the chosen ones, median over the scenes.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <random>

#include "odometry/common/exact_clique.h"
#include "odometry/common/greedy_clique.h"
#include "odometry/stereo/noisy_rigidity.h"
#include "odometry/thesis/motion.h"

namespace {

using namespace stereo_nav;
using namespace stereo_nav::odometry;
using namespace stereo_nav::vision;

constexpr std::size_t kPoints = 150;
constexpr std::size_t kScenes = 100;
constexpr double kNoise_px = 0.3;
constexpr double kMaxError_px = 1.5;
constexpr int kDraws = 200;
constexpr std::size_t kBudget = 2000;

using Indices = std::vector<std::size_t>;

enum Outliers { kScattered, kOneBody };

struct Scene {
  std::vector<odometry::RigidPoint> points;
  std::vector<bool> is_static;
  Eigen::Isometry3d T_now_before;
};

vision::StereoCalibration thesisRig() {
  vision::StereoCalibration calibration;
  calibration.width = 320;
  calibration.height = 240;
  calibration.fx = calibration.fy = 463.8;
  calibration.cx = calibration.right_cx = 160.0;
  calibration.cy = 120.0;
  calibration.baseline_m = 0.1226;
  return calibration;
}

/// Seen in both images with noise, and triangulated again.
Eigen::Vector3d measured(const vision::StereoCalibration& c, const Eigen::Vector3d& p, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, kNoise_px);
  const double disparity = std::max(0.5, c.fx * c.baseline_m / p.z() + noise(random));
  const double z = c.fx * c.baseline_m / disparity;
  return {p.x() / p.z() * z + noise(random) / c.fx * z, p.y() / p.z() * z + noise(random) / c.fx * z, z};
}

Scene makeScene(double outlier_share, Outliers kind, unsigned seed) {
  const vision::StereoCalibration calibration = thesisRig();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Scene scene;
  scene.T_now_before = Eigen::Translation3d(0.02 * unit(random), 0.01 * unit(random), -0.05) *
                       Eigen::AngleAxisd(0.03 * unit(random), Eigen::Vector3d::UnitY());
  // A body that comes nearer on its own way, or features that were confused with others.
  const Eigen::Vector3d own_motion(0.1 * unit(random), 0.0, -0.1);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const double z = 1.0 / (0.08 + 0.28 * (unit(random) + 1.0));  // 1.5 to 12 m, as many near as far
    const Eigen::Vector3d before(0.33 * unit(random) * z, 0.25 * unit(random) * z, z);
    Eigen::Vector3d now = scene.T_now_before * before;
    const bool is_static = static_cast<double>(i) >= outlier_share * kPoints;
    if (!is_static) {
      now += kind == kOneBody ? own_motion
                              : Eigen::Vector3d(unit(random), unit(random), unit(random)) * 0.15 * z;
    }
    scene.points.push_back({measured(calibration, before, random), measured(calibration, now, random)});
    scene.is_static.push_back(is_static);
  }
  return scene;
}

Indices chooseStar(const odometry::ConsistencyGraph& graph) {
  Indices best;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    Indices members;
    for (std::size_t j = 0; j < graph.size(); ++j) {
      if (i == j || graph.connected(i, j)) members.push_back(j);
    }
    if (members.size() > best.size()) best = members;
  }
  return best;
}

Indices agreeing(const vision::StereoCalibration& calibration,
                 const std::vector<odometry::RigidPoint>& points, const Eigen::Isometry3d& T) {
  Indices members;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d error =
        odometry::reprojectionResidual(calibration, {points[i].before, points[i].now}, T, nullptr);
    if (error.norm() <= kMaxError_px) members.push_back(i);
  }
  return members;
}

Indices chooseRansac(const vision::StereoCalibration& calibration,
                     const std::vector<odometry::RigidPoint>& points) {
  std::mt19937 random(1);
  Indices best;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<odometry::PointPair> pairs;
    for (int k = 0; k < 3; ++k) {
      const odometry::RigidPoint& point = points[random() % points.size()];
      pairs.push_back({point.before, point.now});
    }
    Indices members = agreeing(calibration, points, odometry::alignPoints(pairs));
    if (members.size() > best.size()) best = std::move(members);
  }
  return best;
}

enum odometry::Method { kExact, kGreedy, kStar, kRansac };

Indices choose(odometry::Method method, const vision::StereoCalibration& calibration,
               const std::vector<odometry::RigidPoint>& points) {
  if (method == kRansac) return chooseRansac(calibration, points);
  const odometry::ConsistencyGraph graph = odometry::buildNoisyRigidityGraph({}, calibration, points);
  if (method == kGreedy) return odometry::greedyClique(graph);
  return method == kStar ? chooseStar(graph) : odometry::largestClique(graph, kBudget).members;
}

double motionError_mm(const vision::StereoCalibration& calibration, const Scene& scene,
                      const Indices& chosen) {
  std::vector<odometry::PointPair> pairs;
  for (const std::size_t i : chosen) pairs.push_back({scene.points[i].before, scene.points[i].now});
  if (pairs.size() < 3) return 1e3;
  const odometry::RefinedMotion motion =
      odometry::refineMotion({}, calibration, pairs, odometry::alignPoints(pairs));
  return 1e3 * (motion.T_current_previous.translation() - scene.T_now_before.translation()).norm();
}

void rigidity(benchmark::State& state, odometry::Method method, Outliers kind) {
  const vision::StereoCalibration calibration = thesisRig();
  std::vector<Scene> scenes;
  for (unsigned seed = 0; seed < kScenes; ++seed) {
    scenes.push_back(makeScene(0.01 * static_cast<double>(state.range(0)), kind, seed));
  }
  double found = 0.0;
  double wrong = 0.0;
  double all_static = 0.0;
  double all_chosen = 0.0;
  std::vector<double> errors_mm;
  for (const Scene& scene : scenes) {
    const Indices chosen = choose(method, calibration, scene.points);
    all_static += static_cast<double>(std::count(scene.is_static.begin(), scene.is_static.end(), true));
    all_chosen += static_cast<double>(chosen.size());
    for (const std::size_t i : chosen) ++(scene.is_static[i] ? found : wrong);
    errors_mm.push_back(motionError_mm(calibration, scene, chosen));
  }
  std::size_t next = 0;
  for (auto _ : state) benchmark::DoNotOptimize(choose(method, calibration, scenes[next++ % kScenes].points));
  const auto middle = errors_mm.begin() + kScenes / 2;
  std::nth_element(errors_mm.begin(), middle, errors_mm.end());
  state.counters["recall_percent"] = 100.0 * found / all_static;
  state.counters["wrong_percent"] = 100.0 * wrong / all_chosen;
  state.counters["motion_mm"] = *middle;
}

void shares(benchmark::internal::Benchmark* bench) {
  for (const int percent : {10, 30, 45, 60}) bench->Arg(percent);
  bench->Unit(benchmark::kMicrosecond);
}
BENCHMARK_CAPTURE(rigidity, exact_scattered, kExact, kScattered)->Apply(shares);
BENCHMARK_CAPTURE(rigidity, greedy_scattered, kGreedy, kScattered)->Apply(shares);
BENCHMARK_CAPTURE(rigidity, star_scattered, kStar, kScattered)->Apply(shares);
BENCHMARK_CAPTURE(rigidity, ransac_scattered, kRansac, kScattered)->Apply(shares);
BENCHMARK_CAPTURE(rigidity, exact_one_body, kExact, kOneBody)->Apply(shares);
BENCHMARK_CAPTURE(rigidity, greedy_one_body, kGreedy, kOneBody)->Apply(shares);
BENCHMARK_CAPTURE(rigidity, star_one_body, kStar, kOneBody)->Apply(shares);
BENCHMARK_CAPTURE(rigidity, ransac_one_body, kRansac, kOneBody)->Apply(shares);

}  // namespace

BENCHMARK_MAIN();
