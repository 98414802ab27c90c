#include "tools/fuse/fuse_options.h"

#include <filesystem>
#include <sstream>

#include "ros/package_files.h"
#include "stereo_nav/core/input_error.h"
#include "tools/common/command_line.h"

namespace stereo_nav::tools {

std::optional<FuseOptions> parseFuseOptions(int argc, char** argv) {
  namespace po = boost::program_options;
  po::options_description visible(helpHeading(
      "usage: fuse BAG [options]",
      "Runs the filter of ekf_localization over the topics of a recording, as fast as it can, and measures it "
      "against ground truth. Two runs give the same bytes."));
  visible.add_options()        //
      ("help,h", "this text")  //
      ("config", po::value<std::string>()->default_value("fusion/planar.yaml"),
       "parameters of the filter, ours or those of robot_localization: a path, or a file of the package's config folder")  //
      ("laser-config", po::value<std::string>()->default_value("laser_odometry.yaml"),
       "parameters of the laser odometry, which is run where the bag holds scans but no laser/odom")  //
      ("only", po::value<std::string>(),
       "sensors of the file that are used, e.g. odom0,imu0 (default: all)")  //
      ("ground-truth", po::value<std::string>(),
       "TUM trajectory file, or topic in the bag (default: ground_truth/odom if the bag has it)")  //
      ("ground-truth-frame", po::value<std::string>(),
       "frame whose poses the ground truth gives (default: the topic's child frame, else base_link)")  //
      ("output", po::value<std::string>(), "folder for the results (default: NAME_OF_BAG_fusion)");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "bag", values)) return std::nullopt;
  if (values.count("bag") == 0) throw InputError("no BAG given; see fuse --help");
  FuseOptions options;
  options.bag = values["bag"].as<std::string>();
  options.config = ros_io::configFile(values["config"].as<std::string>());
  options.laser_config = ros_io::configFile(values["laser-config"].as<std::string>());
  if (values.count("only") != 0) {
    std::istringstream list(values["only"].as<std::string>());
    for (std::string name; std::getline(list, name, ',');) options.only.insert(name);
  }
  if (values.count("ground-truth") != 0) options.ground_truth = values["ground-truth"].as<std::string>();
  if (values.count("ground-truth-frame") != 0)
    options.ground_truth_frame = values["ground-truth-frame"].as<std::string>();
  options.output = values.count("output") != 0
                       ? values["output"].as<std::string>()
                       : std::filesystem::path(options.bag).stem().string() + "_fusion";
  return options;
}

}  // namespace stereo_nav::tools
