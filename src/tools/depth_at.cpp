// Distance at a pixel of the rectified left image, with statistics over the frames of a recording.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "command_line.h"
#include "package_files.h"
#include "program.h"
#include "stereo_nav/params/parameters.h"
#include "stereo_nav/ros_io/recording.h"
#include "stereo_nav/ros_io/stereo_processing.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

struct Options {
  std::string bag;
  cv::Rect window;
  int disparity_range = 0;  ///< 0: as configured
  ros_io::RecordingOptions part;
  bool each = false;
};

std::optional<Options> parse(int argc, char** argv) {
  Options options;
  int size = 5;
  po::options_description visible(
      "usage: depth_at BAG --pixel X Y [options]\n"
      "Distance along the view at a pixel of the rectified left image: the median over a window, then mean, "
      "spread and "
      "range over the frames. Disparity is that of the nodelets");
  visible.add_options()                                                                 //
      ("help,h", "this text")                                                           //
      ("pixel", po::value<std::vector<int>>()->multitoken(), "column and row, from 0")  //
      ("window", po::value<int>(&size), "width of the window in px (default 5)")        //
      ("disparity-range", po::value<int>(&options.disparity_range),
       "disparities searched, a multiple of 16 (default: config/disparity.yaml)")                   //
      ("start", po::value<double>(&options.part.start_s), "seconds of the recording to skip")       //
      ("duration", po::value<double>(&options.part.duration_s), "seconds of the recording to use")  //
      ("each", "also one line per frame: stamp and distance, 'nan' where there is no disparity");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "bag", values)) return std::nullopt;
  if (values.count("bag") == 0 || values.count("pixel") == 0 ||
      values["pixel"].as<std::vector<int>>().size() != 2) {
    throw ros_io::InputError("BAG and --pixel X Y are needed; see depth_at --help");
  }
  if (size < 1 || options.disparity_range < 0 || options.disparity_range % 16 != 0) {
    throw ros_io::InputError("--window must be 1 or more, --disparity-range a multiple of 16");
  }
  options.bag = values["bag"].as<std::string>();
  const auto pixel = values["pixel"].as<std::vector<int>>();
  options.window = cv::Rect(pixel[0] - size / 2, pixel[1] - size / 2, size, size);
  options.each = values.count("each") != 0;
  return options;
}

/// Median of the window's disparities; nothing where fewer than half of its pixels have one.
std::optional<double> medianDisparity(const cv::Mat& window) {
  std::vector<float> values;
  for (const float value : cv::Mat_<float>(window)) {
    if (value > 0.0f) values.push_back(value);
  }
  if (2 * values.size() < window.total()) return std::nullopt;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void printStatistics(const std::vector<double>& depths_m, std::size_t frames) {
  if (depths_m.empty()) {
    std::printf(
        "no disparity at the pixel in any of %zu frames: too near for the range searched, hidden from the "
        "right "
        "camera, or without texture\n",
        frames);
    return;
  }
  double sum = 0.0, squares = 0.0;
  for (const double depth : depths_m) sum += depth, squares += depth * depth;
  const double n = static_cast<double>(depths_m.size()), mean = sum / n;
  const auto [least, most] = std::minmax_element(depths_m.begin(), depths_m.end());
  std::printf("mean %.3f m, standard deviation %.3f m, from %.3f to %.3f m, in %zu of %zu frames\n", mean,
              std::sqrt(std::max(squares / n - mean * mean, 0.0)), *least, *most, depths_m.size(), frames);
}

int run(int argc, char** argv) {
  const auto options = parse(argc, argv);
  if (!options) return 0;
  const ros_io::Recording recording(options->bag, options->part);
  ros_io::DisparityParams disparity_params;
  const std::string file = configFile("disparity.yaml");
  readParameters(loadYamlFile(file), file, disparity_params);
  if (options->disparity_range != 0) disparity_params.disparity_range = options->disparity_range;
  const ros_io::StereoProcessing processing(recording.leftInfo(), recording.rightInfo(), disparity_params);
  const vo::StereoCalibration& calibration = processing.calibration();
  if ((options->window & cv::Rect(0, 0, calibration.width, calibration.height)) != options->window) {
    throw ros_io::InputError("the window around --pixel leaves the image of " +
                             std::to_string(calibration.width) + " x " + std::to_string(calibration.height));
  }
  std::vector<double> depths_m;
  std::size_t frames = 0;
  recording.forEachPair([&](const ros_io::RawPair& pair) {
    const cv::Mat map =
        processing.disparity(processing.rectifyLeft(pair.left), processing.rectifyRight(pair.right));
    const auto disparity_px = medianDisparity(map(options->window));
    const double depth_m =
        disparity_px ? calibration.fx * calibration.baseline_m / *disparity_px : std::nan("");
    if (disparity_px) depths_m.push_back(depth_m);
    if (options->each) std::printf("%.6f %.4f\n", pair.left_time_s, depth_m);
    ++frames;
  });
  printStatistics(depths_m, frames);
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("depth_at", stereo_nav::tools::run, argc, argv);
}
