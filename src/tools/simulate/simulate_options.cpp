#include "tools/simulate/simulate_options.h"

#include <algorithm>
#include <iostream>
#include <thread>

#include "ros/package_files.h"
#include "sim/scenario.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "stereo_nav/ros/conversions.h"
#include "tools/common/command_line.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

template <class Params>
void printTable(const char* title, const Params& params) {
  std::cout << title << ":\n";
  for (const ParameterDoc& doc : documentParameters(params)) {
    std::cout << "  " << doc.name << " = " << doc.default_value << " " << doc.unit << " (" << doc.range
              << "): " << doc.doc << "\n";
  }
}

void printParameters() {
  printTable("sections of a scenario", sim::Scenario());
  printTable("items of the list `path`", sim::PathStep());
  printTable("items of the list `objects`", sim::ObjectParams());
  printTable("items of the list `clutter`", sim::ClutterParams());
  printTable("items of the list `events`", sim::Event());
}

std::string calibrationFolder(const po::variables_map& values) {
  if (values.count("calibration") != 0) return values["calibration"].as<std::string>();
  return ros_io::thesisCalibrationFolder();
}

}  // namespace

std::optional<SimulateOptions> parseSimulateOptions(int argc, char** argv) {
  SimulateOptions options;
  options.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  po::options_description visible(helpHeading(
      "usage: simulate SCENARIO --output BAG [options]",
      "Drives a robot through a simulated world and records what its cameras and IMU measure, and the "
      "ground truth. SCENARIO is a file, or the name of one in the package's config/scenarios. The same "
      "seed gives the same bytes."));
  visible.add_options()                                                           //
      ("help,h", "this text")                                                     //
      ("parameters", "lists what a scenario may hold, with ranges and defaults")  //
      ("output", po::value<std::string>(&options.output), "bag to write")         //
      ("seed", po::value<std::uint64_t>(&options.seed),
       "seed of noise, jitter and IMU errors (default 1)")  //
      ("time-offset-ms", po::value<double>(),
       "right images are taken this much later; same as --set timing.time_offset_ms=S")  //
      ("set", po::value<std::vector<std::string>>(&options.overrides),
       "NAME=VALUE, changes a parameter of the scenario, e.g. imu.kind=perfect; may be repeated")  //
      ("calibration", po::value<std::string>(),
       "folder with left.yaml and right.yaml (default: the thesis' rig)")  //
      ("rig", po::value<std::string>(&options.rig),
       "rig file whose section drive describes the wheels: the bag gets wheel_ticks, too")  //
      ("true-rig", po::value<std::string>(&options.true_rig),
       "rig file to write, with the wheels as they truly are (--set wheels.radius_sigma=0.01)")  //
      ("commands", po::value<std::string>(&options.commands),
       "file of lines TIME FORWARD LEFT TURNING (s, m/s, m/s, rad/s) that drive the robot of --rig in place of the "
       "scenario's path; the bag gets joint_states, scan, range/*, contacts, too")                         //
      ("duration", po::value<double>(&options.duration_s), "seconds to record (default: the whole path)")  //
      ("threads", po::value<int>(&options.threads), "for rendering; the result does not depend on it")     //
      ("no-images", "IMU and ground truth only")                                                           //
      ("compress", "a smaller bag (bz2), slower to write and read");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "scenario", values)) return std::nullopt;
  if (values.count("parameters") != 0) {
    printParameters();
    return std::nullopt;
  }
  if (values.count("scenario") == 0) throw InputError("no SCENARIO given; see simulate --help");
  if (options.output.empty()) throw InputError("no --output BAG given; see simulate --help");
  if (!options.true_rig.empty() && options.rig.empty())
    throw InputError("--true-rig needs --rig FILE, which has the nominal wheels");
  if (!options.commands.empty() && options.rig.empty())
    throw InputError(
        "--commands needs --rig FILE, whose sections say what drives and measures, e.g. simulated.yaml");
  if (options.threads < 1) throw InputError("--threads must be 1 or more");
  if (!(options.duration_s > 0.0)) throw InputError("--duration must be a number of seconds above 0");
  if (values.count("time-offset-ms") != 0) {
    options.overrides.push_back("timing.time_offset_ms=" +
                                std::to_string(values["time-offset-ms"].as<double>()));
  }
  options.scenario = ros_io::scenarioFile(values["scenario"].as<std::string>());
  options.calibration = calibrationFolder(values);
  options.images = values.count("no-images") == 0;
  options.compress = values.count("compress") != 0;
  return options;
}

}  // namespace stereo_nav::tools
