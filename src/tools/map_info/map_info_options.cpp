#include "tools/map_info/map_info_options.h"

#include "stereo_nav/core/input_error.h"
#include "tools/common/command_line.h"

namespace stereo_nav::tools {

std::optional<MapInfoOptions> parseMapInfoOptions(int argc, char** argv) {
  namespace po = boost::program_options;
  MapInfoOptions options;
  po::options_description visible(helpHeading(
      "usage: map_info FILE [options]",
      "Prints what a map holds, exports it, and sets where it lies in the world from three or more pairs of points."));
  visible.add_options()        //
      ("help,h", "this text")  //
      ("tum", po::value<std::string>(&options.tum),
       "write the poses of the keyframes: left optical frame")                                   //
      ("g2o", po::value<std::string>(&options.g2o), "write the pose graph, all loops included")  //
      ("ply", po::value<std::string>(&options.ply),
       "write landmarks (blue) and keyframes (red) as points")                     //
      ("in-world", "write poses and points in the world, where the map knows it")  //
      ("set-world", po::value<std::string>(&options.world_pairs),
       "text file of pairs: x y z in the map, x y z in the world, m, one pair a line")  //
      ("level", "keep z upright: turn the map in the plane only")                       //
      ("scale", "let the size of the map change, too")                                  //
      ("save", po::value<std::string>(&options.save), "write the map with the new transform");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "file", values)) return std::nullopt;
  if (values.count("file") == 0) throw InputError("no FILE given; see map_info --help");
  options.file = values["file"].as<std::string>();
  options.in_world = values.count("in-world") != 0;
  options.freedom.planar = values.count("level") != 0;
  options.freedom.scale = values.count("scale") != 0;
  if (options.world_pairs.empty() != options.save.empty())
    throw InputError("--set-world and --save belong together: the file that is read stays as it is");
  return options;
}

}  // namespace stereo_nav::tools
