// Finds the true geometry of the wheels from drives that something better followed, too.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "calibration/wheel_calibration.h"
#include "core/atomic_file.h"
#include "kinematics/drive_file.h"
#include "odometry/wheel/wheel_odometry_params.h"
#include "ros/package_files.h"
#include "ros/wheel_recording.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "stereo_nav/ros/topics.h"
#include "tools/calibrate_wheels/wheel_report.h"
#include "tools/common/command_line.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

struct Options {
  std::vector<std::string> bags, references;
  std::string rig, output, config = "wheel.yaml";
  ros_io::WheelRecordingOptions part;
  calibration::WheelCalibrationParams params;
  bool dry_run = false;
};

void describeReference(po::options_description& visible, Options& options) {
  auto& params = options.params;
  visible.add_options()  //
      ("reference", po::value(&options.references),
       "where base_link was: a TUM trajectory, such as the trajectory.tum of evaluate, or a topic of the bag "
       "(default: ground_truth/odom); once for all bags, or as often as there are bags")               //
      ("reference-sigma-m", numberOption(params.reference_sigma_m), "noise of its positions, m")       //
      ("reference-sigma-deg", numberOption(params.reference_sigma_deg), "noise of its headings, deg")  //
      ("reference-walk-m", numberOption(params.reference_walk_m),
       "drift of its position on 1 m, m; 0.005 for the stereo odometry")  //
      ("reference-walk-deg", numberOption(params.reference_walk_deg),
       "drift of its heading on 1 m, deg; 0.1 for the stereo odometry")  //
      ("reference-scale-sigma", numberOption(params.reference_scale_sigma),
       "error of all its lengths in common, relative: that of the baseline of the stereo cameras, e.g. 0.003");
}

void describeAssumptions(po::options_description& visible, Options& options) {
  auto& params = options.params;
  visible.add_options()                                                                                     //
      ("window", numberOption(params.window_s), "pieces over which motions are compared, s")                //
      ("radius-sigma", numberOption(params.radius_sigma), "what the radii may be off by, relative")         //
      ("position-sigma-m", numberOption(params.position_sigma_m), "what the contact points may be off by")  //
      ("direction-sigma-deg", numberOption(params.direction_sigma_deg),
       "what the directions may be off by")  //
      ("time-offset-sigma", numberOption(params.time_offset_sigma_s),
       "what the reference's stamps may be off by, s");
}

std::optional<Options> parse(int argc, char** argv) {
  Options options;
  po::options_description visible(helpHeading(
      "usage: calibrate_wheels BAG... --rig FILE [options]",
      "Finds radius, contact point and direction of each wheel, and the errors that are left, and writes them into "
      "the sections drive and wheel_odometry of the rig file; nothing else in it changes. Each BAG holds wheel_ticks of "
      "a drive with a reference: motion capture, ground truth, or the stereo odometry's own trajectory. Squares and "
      "circles both ways, or a few minutes by the stick, determine everything; what is missing is said. Exit "
      "status: 0 written, 1 the drives do not determine the geometry (nothing is written), 2 input that cannot be used."));
  visible.add_options()                                                                     //
      ("help,h", "this text")                                                               //
      ("rig", po::value(&options.rig), "rig file with the nominal geometry")                //
      ("output", po::value(&options.output), "rig file to write (default: the same file)")  //
      ("dry-run", po::bool_switch(&options.dry_run), "only say what would be written")      //
      ("config", po::value(&options.config)->default_value(options.config),
       "parameters of the wheel odometry")                                              //
      ("start", po::value(&options.part.start_s), "seconds of each recording to skip")  //
      ("duration", po::value(&options.part.duration_s), "seconds of each recording to use");
  describeReference(visible, options);
  describeAssumptions(visible, options);
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "bag", values, Positional::kMany)) return std::nullopt;
  if (values.count("bag") == 0 || options.rig.empty())
    throw InputError("BAG and --rig FILE are needed; see calibrate_wheels --help");
  options.bags = values["bag"].as<std::vector<std::string>>();
  if (options.references.empty()) options.references = {ros_io::topics::kGroundTruth};
  if (options.references.size() != 1 && options.references.size() != options.bags.size())
    throw InputError(fmt::format("{} --reference for {} bags; give one for all (a topic), or one for each",
                                 options.references.size(), options.bags.size()));
  if (options.output.empty()) options.output = options.rig;
  validateParameters(options.params, "options");
  return options;
}

calibration::WheelRun readRun(const Options& options, std::size_t index,
                              const kinematics::DriveParams& drive) {
  const ros_io::WheelRecording recording(options.bags[index], drive, options.part);
  for (const auto& note : recording.notes())
    std::fprintf(stderr, "calibrate_wheels: note: %s: %s\n", options.bags[index].c_str(), note.c_str());
  const std::string& reference = options.references[options.references.size() == 1 ? 0 : index];
  const bool is_file = std::filesystem::exists(reference);
  return {recording.samples(),
          is_file ? readTum(reference) : recording.robot().poses(reference, true).trajectory};
}

void writeRig(const Options& options, const calibration::WheelCalibration& found, RigFile& rig) {
  kinematics::writeDrive(found.params.drive, rig);
  const auto set = [&rig](const char* name, double value) {
    rig.setNumber({rig_sections::kWheelOdometry, name}, fmt::format("{:.6f}", value));
  };
  set("slip_sigma_m", found.params.slip_sigma_m);
  set("scale_sigma", found.params.scale_sigma);
  writeFileAtomically(options.output, rig.text());
  std::printf("written into %s\n", options.output.c_str());
}

int run(int argc, char** argv) {
  const auto options = parse(argc, argv);
  if (!options) return 0;
  RigFile rig = RigFile::load(options->rig);
  const odometry::WheelOdometryParams nominal =
      odometry::loadWheelOdometry(ros_io::configFile(options->config), rig);
  {  // A file that cannot be written is refused before the long part begins.
    RigFile copy(rig);
    kinematics::writeDrive(nominal.drive, copy);
    const AtomicFile writable(options->output);
  }
  std::vector<calibration::WheelRun> runs;
  for (std::size_t i = 0; i < options->bags.size(); ++i) runs.push_back(readRun(*options, i, nominal.drive));
  const auto found = calibration::calibrateWheels(nominal, runs, options->params);
  printCalibration(found, nominal.drive, options->params);
  const std::string missing = calibration::missingMotions(found.motions, kinematics::Drive(nominal.drive));
  if (!missing.empty()) std::fprintf(stderr, "calibrate_wheels: note: %s\n", missing.c_str());
  if (!found.usable()) {
    std::fprintf(stderr, "calibrate_wheels: %s\n", found.refusal.c_str());
    return 1;
  }
  if (!options->dry_run) writeRig(*options, found, rig);
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("calibrate_wheels", stereo_nav::tools::run, argc, argv);
}
