// Drives a simulated robot to goals by what its cameras see, and says where it truly was.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "core/atomic_file.h"
#include "kinematics/drive_file.h"
#include "nodes/obstacle_grid/obstacle_grid_params.h"
#include "ros/driven_rig.h"
#include "ros/package_files.h"
#include "sim/wall_map.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "tools/closed_loop/closed_loop_report.h"
#include "tools/closed_loop/course.h"
#include "tools/common/command_line.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

constexpr double kMapHeight_m = 0.2;  ///< above the floor, of what the map shows
constexpr double kStandstill_s = 2.0;
constexpr double kBeyondBlindZone_m = 0.1;

struct Options {
  std::string scenario, rig, config, obstacles, odometry, output;
  std::vector<std::string> overrides;
  std::uint64_t seed = 1;
  int random = 0;
  bool back = false, map = false, no_imu = false;
};

std::optional<Options> parse(int argc, char** argv) {
  Options options;
  po::options_description visible(helpHeading(
      "usage: closed_loop SCENARIO [options]",
      "Drives the robot of the rig file through a simulated world with the navigator, by its cameras alone: pose by the "
      "visual odometry, obstacles by the disparity. Goals are the places of the scenario's path, or drawn at random. "
      "Nothing runs in real time: the same seed gives the same run. Exit status: 0 all goals reached (within 5 cm and "
      "0.3 % of the way, by the truth) without touching anything while moving, 1 not, 2 input that cannot be used."));
  visible.add_options()                                                                                     //
      ("help,h", "this text")                                                                               //
      ("random", po::value(&options.random)->default_value(0), "so many goals at random places instead")    //
      ("back", po::bool_switch(&options.back), "the path's places once more on the way back to the start")  //
      ("odometry", po::value(&options.odometry)->default_value("vo.yaml"),
       "configuration of the visual odometry, a file or one in the package's config; truth: it knows where it is")  //
      ("no-imu", po::bool_switch(&options.no_imu), "the odometry goes without IMU")                    //
      ("map", po::bool_switch(&options.map), "the robot has a map of what stands there at the start")  //
      ("seed", po::value(&options.seed)->default_value(1), "of noise and random goals")                //
      ("rig", po::value(&options.rig)->default_value("rigs/simulated.yaml"),
       "rig file: wheels and mounting")  //
      ("config", po::value(&options.config)->default_value("navigator.yaml"),
       "parameters of the navigator")  //
      ("obstacles", po::value(&options.obstacles)->default_value("obstacles.yaml"),
       "parameters of the local grid")  //
      ("set", po::value(&options.overrides),
       "NAME=VALUE, changes a parameter of the scenario; may be repeated")  //
      ("output", po::value(&options.output), "folder for goals.csv, trace.csv, summary.json and way.svg");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "scenario", values)) return std::nullopt;
  if (values.count("scenario") == 0) throw InputError("SCENARIO is needed; see closed_loop --help");
  options.scenario = values["scenario"].as<std::string>();
  return options;
}

template <class Params>
Params readConfig(const std::string& name) {
  const std::string file = ros_io::configFile(name);
  Params params;
  readParameters(loadYamlFile(file), file, params);
  return params;
}

SenseOptions senseOptions(const Options& options) {
  SenseOptions senses;
  if (options.odometry != "truth") senses.odometry_config = ros_io::configFile(options.odometry);
  senses.imu = !options.no_imu;
  senses.disparity = readConfig<ros_io::DisparityParams>("disparity.yaml");
  senses.obstacles = readConfig<nodes::ObstacleGridParams>(options.obstacles).grid;
  return senses;
}

/// The simulated robot of the options.
std::unique_ptr<sim::DrivenSimulation> simulationOf(const Options& options) {
  const RigFile rig = RigFile::load(ros_io::configFile(options.rig));
  sim::Scenario scenario = sim::loadScenario(ros_io::scenarioFile(options.scenario), options.overrides);
  scenario.rig.camera = rig.mounting().camera;
  scenario.drive = kinematics::readDrive(rig);
  return std::make_unique<sim::DrivenSimulation>(
      scenario, ros_io::readDrivenDevices(rig).rig,
      sim::loadStereoCalibration(ros_io::thesisCalibrationFolder()), options.seed);
}

void writeFiles(const Options& options, const LoopResults& results, const GoalRun& run,
                const grid::OccupancyGrid& walls) {
  writeFileAtomically(options.output + "/goals.csv", toCsv(results));
  writeFileAtomically(options.output + "/trace.csv", toCsv(run.trace()));
  writeFileAtomically(options.output + "/summary.json", toJson(results));
  const std::string title = fmt::format("{}, {}, seed {}", options.scenario, options.odometry, options.seed);
  writeFileAtomically(options.output + "/way.svg",
                      drawWay(results, run.trace(), walls, title, options.output + "/way"));
}

int run(int argc, char** argv) {
  const auto options = parse(argc, argv);
  if (!options) return 0;
  auto params = readConfig<nodes::NavigatorNodeParams>(options->config);
  params.shareOutline();
  const auto simulation = simulationOf(*options);
  const SenseOptions sense_options = senseOptions(*options);
  const grid::OccupancyGrid walls =
      sim::wallMap(simulation->scene(), simulation->scenario().scene.room, kMapHeight_m);
  const Eigen::Vector2d start = simulation->start().translation().head<2>();
  const auto goals = options->random > 0
                         ? randomGoals(walls, params.planner, start, options->random, options->seed)
                         : pathGoals(simulation->scenario(), start, options->back);
  RobotSenses senses(*simulation, sense_options);
  double& blind_zone_m = params.navigator.check.blind_zone_m;
  if (blind_zone_m == 0.0) blind_zone_m = senses.nearestFloor_m() + kBeyondBlindZone_m;
  GoalRun run(params, *simulation, senses,
              options->map ? std::make_shared<const grid::OccupancyGrid>(walls) : nullptr);
  run.wait(kStandstill_s);
  LoopResults results;
  for (const Eigen::Vector2d& goal : goals) results.goals.push_back(run.driveTo(goal));
  results.collisions = senses.collisions().size();
  results.frames = senses.frames();
  results.frames_lost = senses.framesLost();
  std::printf("%s", table(results).c_str());
  if (!options->output.empty()) writeFiles(*options, results, run, walls);
  return results.reached() == goals.size() && results.collisions == 0 ? 0 : 1;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("closed_loop", stereo_nav::tools::run, argc, argv);
}
