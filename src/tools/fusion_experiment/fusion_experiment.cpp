// What each set of sensors makes of one simulated drive: the experiment behind docs/fusion_experiments.md.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <thread>

#include "core/angles.h"
#include "core/atomic_file.h"
#include "core/statistics.h"
#include "kinematics/drive_file.h"
#include "ros/package_files.h"
#include "sim/simulation.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "tools/common/command_line.h"
#include "tools/common/program.h"
#include "tools/fusion_experiment/subset_run.h"

namespace stereo_nav::tools {
namespace {

struct Options {
  std::string scenario, rig, output;
  std::vector<std::string> overrides = {"imu.kind=raw", "timing.rate_hz=10"};
  std::uint64_t seed = 1;
  int poses = 20;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

std::optional<Options> parse(int argc, char** argv) {
  namespace po = boost::program_options;
  Options options;
  std::vector<std::string> overrides;
  std::string rig = "rigs/mecanum.yaml";
  po::options_description visible(helpHeading(
      "usage: fusion_experiment SCENARIO --output FILE.csv [options]",
      "Simulates a drive with wheels, gyroscope, laser, stereo camera and range finders, runs the filter over each set of them and "
      "writes the errors of each: over the whole way, and at poses that lie equally far apart along it. SCENARIO and --set are those "
      "of `simulate`; the IMU is of kind raw and the cameras take 10 pairs a second unless --set changes it."));
  visible.add_options()                                                                             //
      ("help,h", "this text")                                                                       //
      ("output", po::value<std::string>(&options.output), "CSV file to write, a row for each set")  //
      ("rig", po::value<std::string>(&rig)->default_value(rig),
       "rig file whose section drive describes the wheels")                                    //
      ("set", po::value<std::vector<std::string>>(&overrides), "NAME=VALUE, may be repeated")  //
      ("seed", po::value<std::uint64_t>(&options.seed), "of all that is random (default 1)")   //
      ("poses", po::value<int>(&options.poses), "at which the errors are taken (default 20)")  //
      ("threads", po::value<int>(&options.threads), "for rendering; the result does not depend on it");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "scenario", values)) return std::nullopt;
  if (values.count("scenario") == 0 || options.output.empty())
    throw InputError("SCENARIO and --output FILE are needed; see fusion_experiment --help");
  if (options.poses < 1 || options.threads < 1) throw InputError("--poses and --threads must be 1 or more");
  options.scenario = ros_io::scenarioFile(values["scenario"].as<std::string>());
  options.rig = ros_io::configFile(rig);
  options.overrides.insert(options.overrides.end(), overrides.begin(), overrides.end());
  return options;
}

struct Rmse {
  Eigen::Vector3d squared = Eigen::Vector3d::Zero(), sum = Eigen::Vector3d::Zero();
  double count = 0.0;

  void add(const Eigen::Vector3d& error) {
    squared += error.cwiseAbs2();
    sum += error;
    count += 1.0;
  }
  Eigen::Vector3d value() const { return (squared / count).cwiseSqrt(); }
};

/// The poses at which the robot has come 1/n, 2/n, ... of its way.
std::vector<ComparedPose> alongTheWay(const std::vector<ComparedPose>& all, int n) {
  std::vector<double> way_m = {0.0};
  for (std::size_t i = 1; i < all.size(); ++i)
    way_m.push_back(way_m.back() + (all[i].T_true.translation() - all[i - 1].T_true.translation()).norm());
  std::vector<ComparedPose> chosen;
  for (int k = 1; k <= n; ++k) {
    const auto at = std::lower_bound(way_m.begin(), way_m.end(), way_m.back() * k / n * (1.0 - 1e-9));
    chosen.push_back(all[static_cast<std::size_t>(at - way_m.begin())]);
  }
  return chosen;
}

std::string rowOf(const Subset& subset, const std::vector<ComparedPose>& all, int poses) {
  Rmse whole, at_poses;
  double nees = 0.0, inside = 0.0;
  for (const ComparedPose& pose : all) {
    whole.add(pose.error);
    nees += pose.nees;
    if (pose.nees < chiSquareQuantile(3, 0.95)) inside += 1.0;
  }
  for (const ComparedPose& pose : alongTheWay(all, poses)) at_poses.add(pose.error);
  const Eigen::Vector3d rmse = at_poses.value(), over_all = whole.value(), end = all.back().error;
  const Eigen::Vector3d published = at_poses.sum.cwiseAbs() / std::sqrt(at_poses.count);
  return fmt::format(
      "{},{:.5f},{:.5f},{:.4f},{:.5f},{:.5f},{:.5f},{:.5f},{:.4f},{:.5f},{:.5f},{:.4f},{:.3f},{:.1f}\n",
      subset.name(), rmse[0], rmse[1], rmse[2] * kDegPerRad, published[0], published[1], over_all[0],
      over_all[1], over_all[2] * kDegPerRad, end[0], end[1], end[2] * kDegPerRad, nees / whole.count,
      100.0 * inside / whole.count);
}

int run(int argc, char** argv) {
  const auto options = parse(argc, argv);
  if (!options) return 0;
  { const AtomicFile writable(options->output); }  // before the work, not after it
  sim::Scenario scenario = sim::loadScenario(options->scenario, options->overrides);
  scenario.drive = kinematics::readDrive(RigFile::load(options->rig));
  const sim::Simulation simulation(scenario, sim::loadStereoCalibration(ros_io::thesisCalibrationFolder()),
                                   options->seed);
  const SensorRuns runs = runSensors(simulation, options->seed, options->threads);
  const std::string config = ros_io::configFile("fusion/planar.yaml");
  const estimation::FusionConfig filter = estimation::readFusionConfig(loadYamlFile(config), config);
  std::string table =
      "sensors,rmse_x_m,rmse_y_m,rmse_yaw_deg,published_x_m,published_y_m,whole_x_m,whole_y_m,whole_yaw_deg,end_x_m,end_y_m,"
      "end_yaw_deg,nees,inside_95_percent\n";
  for (const Subset& subset : allSubsets())
    table += rowOf(subset, runSubset(filter, subset, runs, simulation.trajectory()), options->poses);
  writeFileAtomically(options->output, table);
  std::fputs(table.c_str(), stdout);
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("fusion_experiment", stereo_nav::tools::run, argc, argv);
}
