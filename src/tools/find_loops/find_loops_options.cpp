#include "tools/find_loops/find_loops_options.h"

#include <filesystem>
#include <sstream>

#include "ros/package_files.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "tools/common/command_line.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

std::vector<std::size_t> countsOf(const std::string& text) {
  std::vector<std::size_t> counts;
  std::istringstream list(text);
  for (std::string item; std::getline(list, item, ',');) {
    const bool is_number = !item.empty() && item.find_first_not_of("0123456789") == std::string::npos;
    if (!is_number || item.size() > 9)
      throw InputError("--same-after must be numbers of images with commas between them, not '" + text + "'");
    counts.push_back(std::stoul(item));
  }
  return counts;
}

po::options_description describeOptions(FindLoopsOptions& options) {
  po::options_description visible(helpHeading(
      "usage: find_loops BAG [options]\n       find_loops FOLDER [options]",
      "Finds out where a camera came back to a place that it had seen, and proves it. Of a recording of a stereo "
      "rig it runs the odometry, makes keyframes and finds the pose of each loop; of a folder of images of one "
      "camera, in the order of their names, it checks epipolar lines. Two runs give the same list."));
  visible.add_options()                                                                     //
      ("help,h", "this text")                                                               //
      ("output", po::value<std::string>(), "folder for the results (default: NAME_loops)")  //
      ("loop-config", po::value<std::string>()->default_value("loop.yaml"),
       "parameters of recognising places: a path, or a file of the package's config folder")  //
      ("pictures", po::value<int>(&options.pictures)->default_value(options.pictures),
       "pictures of accepted loops at most")  //
      ("config", po::value<std::string>()->default_value("vo.yaml"),
       "parameters of the odometry, likewise")  //
      ("ground-truth", po::value<std::string>(),
       "TUM trajectory file, or topic in the bag (default: ground_truth/odom if the bag has it)")  //
      ("ground-truth-frame", po::value<std::string>(),
       "frame whose poses the ground truth gives (default: the topic's child frame, else base_link)")  //
      ("near-m", numberOption(options.near_m), "truth: keyframes so near to each other ...")           //
      ("near-deg", numberOption(options.near_deg), "... and turned so little show the same place")     //
      ("start", po::value<double>(&options.part.start_s), "seconds of the recording to skip")          //
      ("duration", po::value<double>(&options.part.duration_s), "seconds of the recording to use")     //
      ("no-imu", po::bool_switch(&options.no_imu), "as if the recording held no IMU")                  //
      ("features", po::value<int>(&options.features)->default_value(options.features),
       "corners of each image of a folder at most")  //
      ("threshold", po::value<int>(&options.threshold)->default_value(options.threshold),
       "grey levels by which these stand out at least")  //
      ("epipolar-px", numberOption(options.epipolar_px),
       "largest distance of a match from its epipolar line, in a folder")  //
      ("same-after", po::value<std::string>(),
       "truth of a folder: numbers of images after which the same place is shown again, e.g. 40,80")  //
      ("same-within", po::value<std::size_t>(&options.same_within)->default_value(options.same_within),
       "by how many images these may be off");
  return visible;
}

void check(const FindLoopsOptions& options) {
  if (!std::filesystem::exists(options.input))
    throw InputError(options.input + ": there is no such file or folder");
  if (options.part.start_s < 0.0) throw InputError("--start must be a number of seconds, 0 or more");
  if (!(options.part.duration_s > 0.0)) throw InputError("--duration must be a number of seconds above 0");
  if (options.features < 1 || options.threshold < 1)
    throw InputError("--features and --threshold must be 1 or more");
  if (!(options.epipolar_px > 0.0)) throw InputError("--epipolar-px must be above 0");
}

}  // namespace

std::optional<FindLoopsOptions> parseFindLoopsOptions(int argc, char** argv) {
  FindLoopsOptions options;
  const po::options_description visible = describeOptions(options);
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "input", values)) return std::nullopt;
  if (values.count("input") == 0) throw InputError("no BAG or FOLDER given; see find_loops --help");
  options.input = values["input"].as<std::string>();
  options.config = ros_io::configFile(values["config"].as<std::string>());
  const std::string loop = ros_io::configFile(values["loop-config"].as<std::string>());
  readParameters(loadYamlFile(loop), loop, options.loop);
  if (values.count("ground-truth") != 0) options.ground_truth = values["ground-truth"].as<std::string>();
  if (values.count("ground-truth-frame") != 0)
    options.ground_truth_frame = values["ground-truth-frame"].as<std::string>();
  if (values.count("same-after") != 0) options.same_after = countsOf(values["same-after"].as<std::string>());
  const std::filesystem::path input = std::filesystem::path(options.input).lexically_normal();
  const std::string name = input.has_filename() ? input.stem().string() : input.parent_path().stem().string();
  options.output = values.count("output") != 0 ? values["output"].as<std::string>() : name + "_loops";
  check(options);
  return options;
}

}  // namespace stereo_nav::tools
