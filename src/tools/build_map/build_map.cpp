// Makes a map of a recording, without a master: keyframes, loops, all closed together; trajectories before
// and after.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "core/atomic_file.h"
#include "eval/gnuplot.h"
#include "mapping/map/map_file.h"
#include "ros/package_files.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "tools/build_map/map_report.h"
#include "tools/common/command_line.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

std::optional<BuildMapOptions> parse(int argc, char** argv) {
  BuildMapOptions options;
  std::string config, loop, truth, truth_frame;
  po::options_description visible(helpHeading(
      "usage: build_map BAG [options]",
      "Makes a map of the recording of a stereo rig: runs the odometry, makes keyframes, recognises places, and closes "
      "all loops together, without those that are false. Writes the map, the trajectory before and after, and each loop "
      "with the reason for its rejection. Two runs give the same bytes."));
  visible.add_options()                                                                     //
      ("help,h", "this text")                                                               //
      ("output", po::value(&options.output), "folder for the results (default: NAME_map)")  //
      ("config", po::value(&config)->default_value("vo.yaml"),
       "parameters of the odometry: a path, or a file of the package's config folder")  //
      ("loop-config", po::value(&loop)->default_value("loop.yaml"),
       "parameters of recognising places, likewise")  //
      ("ground-truth", po::value(&truth),
       "TUM trajectory file, or topic in the bag (default: ground_truth/odom if the bag has it)")  //
      ("ground-truth-frame", po::value(&truth_frame),
       "frame whose poses the ground truth gives (default: the topic's child frame, else base_link)")  //
      ("start", po::value(&options.run.part.start_s), "seconds of the recording to skip")              //
      ("duration", po::value(&options.run.part.duration_s), "seconds of the recording to use")         //
      ("no-imu", po::bool_switch(&options.run.no_imu), "as if the recording held no IMU");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "bag", values)) return std::nullopt;
  if (values.count("bag") == 0) throw InputError("no BAG given; see build_map --help");
  options.run.bag = values["bag"].as<std::string>();
  if (!std::filesystem::is_regular_file(options.run.bag))
    throw InputError(options.run.bag + ": there is no such file");
  if (options.output.empty())
    options.output = std::filesystem::path(options.run.bag).stem().string() + "_map";
  options.run.config = ros_io::configFile(config);
  const std::string loop_file = ros_io::configFile(loop);
  readParameters(loadYamlFile(loop_file), loop_file, options.loop);
  if (!truth.empty()) options.run.ground_truth = truth;
  if (!truth_frame.empty()) options.run.ground_truth_frame = truth_frame;
  return options;
}

void showProgress(std::size_t done, std::size_t all) {
  if (isatty(STDERR_FILENO) == 0) return;
  std::fprintf(stderr, "\r%zu of %zu frames%s", done, all, done == all ? "\n" : "");
}

int run(int argc, char** argv) {
  const auto options = parse(argc, argv);
  if (!options) return 0;
  const std::string folder = options->output + "/";
  { const AtomicFile writable(folder + "summary.json"); }  // before the work, not after it
  const MapRun run = buildMap(*options, showProgress);
  const MapFigures figures = figuresOf(run);
  mapping::saveMap(run.map, folder + "place.map");
  writeFileAtomically(folder + "trajectory_before.tum", toTum(eval::estimatedTrajectory(run.before)));
  writeFileAtomically(folder + "trajectory.tum", toTum(eval::estimatedTrajectory(run.after)));
  writeFileAtomically(folder + "loops.csv", loopsCsv(run));
  writeFileAtomically(folder + "summary.json", summaryJson(run, figures));
  writeFileAtomically(folder + "timing.json", timingJson(run));
  writeFileAtomically(folder + "map.svg", eval::runGnuplot(pictureScript(run), folder + "map"));
  print(run, figures);
  for (const std::string& note : run.notes) std::fprintf(stderr, "build_map: note: %s\n", note.c_str());
  std::printf("results in %s\n", options->output.c_str());
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("build_map", stereo_nav::tools::run, argc, argv);
}
