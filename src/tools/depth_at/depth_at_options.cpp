#include "tools/depth_at/depth_at_options.h"

#include <vector>

#include "stereo_nav/core/input_error.h"
#include "tools/common/command_line.h"

namespace stereo_nav::tools {

namespace po = boost::program_options;

std::optional<DepthAtOptions> parseDepthAtOptions(int argc, char** argv) {
  DepthAtOptions options;
  po::options_description visible(helpHeading(
      "usage: depth_at BAG --pixel X Y [options]\n       depth_at --live [--pixel X Y] [options]",
      "Prints the distance along the view at a pixel of the rectified left image: the median over a "
      "window, then mean, spread and range over the frames. The disparity of a recording is computed as by "
      "the nodelets; --live takes camera/disparity. With --live and without --pixel, a window shows "
      "camera/left/image_rect: click into it; any key ends the program."));
  visible.add_options()                                                                           //
      ("help,h", "this text")                                                                     //
      ("live", "from the topics of a running graph")                                              //
      ("pixel", po::value<std::vector<int>>()->multitoken(), "column and row, from 0")            //
      ("window", po::value<int>(&options.window_px), "width of the window in px (default 5)")     //
      ("each", "also one line per frame: stamp and distance, 'nan' where there is no disparity")  //
      ("frames", po::value<int>(&options.frames), "live: frames to collect (default 30)")         //
      ("disparity-range", po::value<int>(&options.disparity_range),
       "recording: disparities searched, a multiple of 16 (default: config/disparity.yaml)")   //
      ("start", po::value<double>(&options.part.start_s), "seconds of the recording to skip")  //
      ("duration", po::value<double>(&options.part.duration_s), "seconds of the recording to use");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "bag", values)) return std::nullopt;
  const bool live = values.count("live") != 0;
  if (live == (values.count("bag") != 0)) {
    throw InputError("either BAG or --live is needed; see depth_at --help");
  }
  if (!live) options.bag = values["bag"].as<std::string>();
  if (values.count("pixel") != 0) {
    const auto pixel = values["pixel"].as<std::vector<int>>();
    if (pixel.size() != 2) throw InputError("--pixel takes two numbers, column and row");
    options.pixel = cv::Point(pixel[0], pixel[1]);
  } else if (!live) {
    throw InputError("a recording needs --pixel X Y; see depth_at --help");
  }
  if (options.window_px < 1 || options.frames < 1) {
    throw InputError("--window and --frames must be 1 or more");
  }
  if (options.disparity_range < 0 || options.disparity_range % 16 != 0) {
    throw InputError("--disparity-range must be a multiple of 16");
  }
  options.each = values.count("each") != 0;
  return options;
}

}  // namespace stereo_nav::tools
