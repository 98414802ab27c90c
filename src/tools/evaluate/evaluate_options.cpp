#include "tools/evaluate/evaluate_options.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <utility>

#include "ros/package_files.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/odometry/common/odometry.h"
#include "tools/common/command_line.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

void checkValues(const EvaluateOptions& options) {
  if (!std::isfinite(options.part.start_s) || options.part.start_s < 0.0) {
    throw InputError("--start must be a number of seconds, 0 or more");
  }
  if (!(options.part.duration_s > 0.0)) throw InputError("--duration must be a number of seconds above 0");
  const double rolling_shutter_s = options.part.rolling_shutter_s.value_or(0.0);
  if (!(rolling_shutter_s >= 0.0 && rolling_shutter_s <= odometry::kLongestReadout_s))
    throw InputError("--rolling-shutter-ms must be a number of milliseconds from 0 to 200");
  if (!(options.truth_sigma_m >= 0.0 && options.truth_sigma_deg >= 0.0))
    throw InputError("--ground-truth-sigma-m and --ground-truth-sigma-deg must be 0 or more");
  if (options.repeat < 1) throw InputError("--repeat must be 1 or more");
}

std::vector<double> lengthsOf(const std::string& text) {
  std::vector<double> lengths_m;
  std::istringstream list(text);
  for (std::string item; std::getline(list, item, ',');) {
    char* end = nullptr;
    const double length_m = std::strtod(item.c_str(), &end);
    if (item.empty() || *end != '\0' || !(length_m > 0.0 && std::isfinite(length_m)))
      throw InputError("--segments must be lengths in m above 0, with commas between them, not '" + text +
                       "'");
    lengths_m.push_back(length_m);
  }
  return lengths_m;
}

void readMethod(const po::variables_map& values, EvaluateOptions& options) {
  const auto method = values["method"].as<std::string>();
  const std::map<std::string, std::pair<EvaluatedMethod, std::string>> methods = {
      {"visual", {EvaluatedMethod::kVisual, "vo.yaml"}},
      {"wheel", {EvaluatedMethod::kWheel, "wheel.yaml"}},
#ifdef STEREO_NAV_MAPPING
      {"mono", {EvaluatedMethod::kMono, "mono_slam.yaml"}},
#endif
      {"laser", {EvaluatedMethod::kLaser, "laser_odometry.yaml"}}};
  const auto chosen = methods.find(method);
  if (chosen == methods.end())
    throw InputError("--method must be visual, wheel, laser or mono, not '" + method + "'");
  options.method = chosen->second.first;
  const bool wheel = options.method == EvaluatedMethod::kWheel;
  if (values.count("rig") != 0) options.rig = values["rig"].as<std::string>();
  if (wheel && options.rig.empty())
    throw InputError("--method wheel needs --rig FILE, a rig file with the section drive");
  const bool takes_prior =
      options.method == EvaluatedMethod::kLaser || options.method == EvaluatedMethod::kMono;
  if (options.no_prior && !takes_prior)
    throw InputError(
        "--no-prior is for --method laser or mono: the other methods take no wheels for a prior");
  options.config = ros_io::configFile(values.count("config") != 0 ? values["config"].as<std::string>()
                                                                  : chosen->second.second);
}

void readValues(const po::variables_map& values, EvaluateOptions& options) {
  readMethod(values, options);
  if (values.count("segments") != 0)
    options.segment_lengths_m = lengthsOf(values["segments"].as<std::string>());
  options.disparity_config = ros_io::configFile(values["disparity-config"].as<std::string>());
  if (values.count("disparity-from") != 0)
    options.disparity_from = values["disparity-from"].as<std::string>();
  if (values.count("ground-truth") != 0) options.ground_truth = values["ground-truth"].as<std::string>();
  if (values.count("ground-truth-frame") != 0) {
    options.ground_truth_frame = values["ground-truth-frame"].as<std::string>();
  }
  if (values.count("namespace") != 0) options.part.rig = values["namespace"].as<std::string>();
  if (values.count("rolling-shutter-ms") != 0)
    options.part.rolling_shutter_s = 1e-3 * values["rolling-shutter-ms"].as<double>();
  options.output = values.count("output") != 0
                       ? values["output"].as<std::string>()
                       : std::filesystem::path(options.bag).stem().string() + "_evaluation";
}

po::options_description describeOptions(EvaluateOptions& options) {
  po::options_description visible(helpHeading(
      "usage: evaluate BAG [options]",
      "Runs the odometry on a recording as fast as it can and measures it against ground truth."));
  visible.add_options()        //
      ("help,h", "this text")  //
      ("method", po::value<std::string>()->default_value("visual"),
       "visual: the odometry of the images; wheel: that of wheel_ticks, with imu/data where the bag has it; laser: that "
       "of scan, with wheel/odom and imu/data where the bag has them; mono: EKF-SLAM with the left camera alone, with "
       "wheel/odom and imu/data where the bag has them")  //
      ("rig", po::value<std::string>(),
       "rig file: for --method wheel its section drive, which describes the wheels; for visual its section uncertainty, "
       "which says how good the calibration is. The cameras' mounting is read from the bag.")  //
      ("config", po::value<std::string>(),
       "parameters of the odometry: a path, or a file of the package's config folder (default: vo.yaml, "
       "wheel.yaml, laser_odometry.yaml or mono_slam.yaml)")  //
      ("disparity-config", po::value<std::string>()->default_value("disparity.yaml"),
       "parameters of the disparity map, where the odometry uses one; looked up in the same way")  //
      ("disparity-from", po::value<std::string>(),
       "bag whose camera/disparity is used instead of a computed map, e.g. BAG itself")  //
      ("ground-truth", po::value<std::string>(),
       "TUM trajectory file, or topic in the bag (default: ground_truth/odom if the bag has it)")  //
      ("ground-truth-frame", po::value<std::string>(),
       "frame whose poses the ground truth gives (default: the topic's child frame, else base_link)")  //
      ("ground-truth-sigma-m", po::value<double>(&options.truth_sigma_m),
       "noise of the ground truth's positions, which the covariances are not to be blamed for: about 0.001 for motion "
       "capture, 0.02 for GPS with an inertial system")  //
      ("ground-truth-sigma-deg", po::value<double>(&options.truth_sigma_deg),
       "likewise of its attitudes: about 0.05")                                                          //
      ("output", po::value<std::string>(), "folder for the results (default: NAME_OF_BAG_evaluation)")   //
      ("start", po::value<double>(&options.part.start_s), "seconds of the recording to skip")            //
      ("duration", po::value<double>(&options.part.duration_s), "seconds of the recording to use")       //
      ("namespace", po::value<std::string>(), "rig to use, where the bag holds several, e.g. /robot_a")  //
      ("rolling-shutter-ms", po::value<double>(),
       "time from an image's first row to its last, instead of what the recording says; 0: global shutter. "
       "The stamps are taken as those of the middle row.")  //
      ("planar", po::bool_switch(&options.on_floor),
       "the robot drives on the plane of its start: height, roll and pitch are held there")  //
      ("no-imu", po::bool_switch(&options.no_imu),
       "the path of vision alone, as if the recording held no IMU")  //
      ("no-prior", po::bool_switch(&options.no_prior),
       "the path of the laser, or of the camera, alone, as if the recording held neither wheels nor IMU")  //
      ("segments", po::value<std::string>(),
       "lengths in m of pieces that the errors are taken over as well, e.g. 5,10; they go to summary.json")  //
      ("repeat", po::value<int>(&options.repeat), "run this many times, for the timing; results must agree");
  return visible;
}

}  // namespace

std::optional<EvaluateOptions> parseEvaluateOptions(int argc, char** argv) {
  EvaluateOptions options;
  const po::options_description visible = describeOptions(options);
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "bag", values)) return std::nullopt;
  if (values.count("bag") == 0) throw InputError("no BAG given; see evaluate --help");
  options.bag = values["bag"].as<std::string>();
  readValues(values, options);
  checkValues(options);
  return options;
}

}  // namespace stereo_nav::tools
