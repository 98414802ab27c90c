// Distance at a pixel of the rectified left image, with statistics over the frames of a recording or of live
// topics.
#include <ros/init.h>

#include <cmath>
#include <cstdio>

#include "ros/package_files.h"
#include "ros/stereo_processing.h"
#include "stereo_nav/core/parameters.h"
#include "tools/common/program.h"
#include "tools/depth_at/depth_at_options.h"
#include "tools/depth_at/depth_live.h"
#include "tools/depth_at/depth_statistics.h"

namespace stereo_nav::tools {
namespace {

void measureRecording(const DepthAtOptions& options) {
  const ros_io::Recording recording(options.bag, options.part);
  ros_io::DisparityParams disparity_params;
  const std::string file = ros_io::configFile("disparity.yaml");
  readParameters(loadYamlFile(file), file, disparity_params);
  if (options.disparity_range != 0) disparity_params.disparity_range = options.disparity_range;
  const ros_io::StereoProcessing processing(recording.leftInfo(), recording.rightInfo(), disparity_params);
  const vision::StereoCalibration& calibration = processing.calibration();
  const cv::Rect window =
      windowAround(*options.pixel, options.window_px, {calibration.width, calibration.height});
  DepthStatistics statistics;
  recording.forEachPair([&](const ros_io::RawPair& pair) {
    const cv::Mat map =
        processing.disparity(processing.rectifyLeft(pair.left), processing.rectifyRight(pair.right));
    std::optional<double> depth_m;
    if (const auto disparity_px = medianDisparity(map(window))) {
      depth_m = calibration.fx * calibration.baseline_m / *disparity_px;
    }
    statistics.add(depth_m);
    if (options.each) std::printf("%.6f %.4f\n", pair.left_time_s, depth_m.value_or(NAN));
  });
  std::printf("%s\n", statistics.text().c_str());
}

int run(int argc, char** argv) {
  ros::init(argc, argv, "depth_at", ros::init_options::AnonymousName);
  const auto options = parseDepthAtOptions(argc, argv);
  if (!options) return 0;
  if (options->live()) {
    measureLive(*options);
  } else {
    measureRecording(*options);
  }
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("depth_at", stereo_nav::tools::run, argc, argv);
}
