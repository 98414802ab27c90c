#include "tools/optimise_graph/optimise_options.h"

#include <filesystem>

#include "stereo_nav/core/input_error.h"
#include "tools/common/command_line.h"

namespace stereo_nav::tools {

std::optional<OptimiseOptions> parseOptimiseOptions(int argc, char** argv) {
  namespace po = boost::program_options;
  OptimiseOptions options;
  po::options_description visible(helpHeading(
      "usage: optimise_graph FILE.g2o [options]",
      "Finds the poses at which the error of a pose graph in the plane or in space is least, prints chi-square and time, and "
      "writes graph, trajectory, figures and a picture. Two runs give the same poses."));
  visible.add_options()        //
      ("help,h", "this text")  //
      ("output", po::value<std::string>(&options.output),
       "folder for the results (default: NAME_OF_FILE_optimised)")  //
      ("robust",
       "tell false loops from true ones, and list each in loops.csv with why it was rejected")  //
      ("false-loops", numberOption(options.false_loops_percent),
       "add so many false loops, in percent of the loops of the file, to see what becomes of them")  //
      ("seed", po::value<std::uint64_t>(&options.seed)->default_value(options.seed), "of these loops");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "file", values)) return std::nullopt;
  if (values.count("file") == 0) throw InputError("no FILE.g2o given; see optimise_graph --help");
  options.file = values["file"].as<std::string>();
  options.robust = values.count("robust") != 0;
  if (!(options.false_loops_percent >= 0.0 && options.false_loops_percent <= 1000.0))
    throw InputError("--false-loops takes 0 to 1000 percent");
  if (options.output.empty())
    options.output = std::filesystem::path(options.file).stem().string() + "_optimised";
  return options;
}

}  // namespace stereo_nav::tools
