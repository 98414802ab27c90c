// The disparity map that a perfect matcher would find on a simulated drive; it shows how much of an error a
// real one causes.
#include <cv_bridge/cv_bridge.h>
#include <stereo_msgs/DisparityImage.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "ros/bag_file.h"
#include "ros/package_files.h"
#include "sim/simulation.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"
#include "stereo_nav/ros/recording.h"
#include "stereo_nav/ros/topics.h"
#include "tools/common/command_line.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

struct Options {
  std::string scenario, output;
  std::vector<std::string> overrides;
  double step_px = 0.0;
};

std::optional<Options> parse(int argc, char** argv) {
  Options options;
  po::options_description visible(helpHeading(
      "usage: true_disparity SCENARIO --output BAG [options]",
      "Writes camera/disparity of a simulated drive as a perfect matcher would find it, for `evaluate "
      "--disparity-from`. SCENARIO and --set are those of `simulate`; both cameras must take their images "
      "at the same time."));
  visible.add_options()                                                                                //
      ("help,h", "this text")                                                                          //
      ("output", po::value<std::string>(&options.output), "bag to write")                              //
      ("set", po::value<std::vector<std::string>>(&options.overrides), "NAME=VALUE, may be repeated")  //
      ("step-px", po::value<double>(&options.step_px),
       "round to multiples of this; matchers have 1/16 (default: 0, no rounding)");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "scenario", values)) return std::nullopt;
  if (values.count("scenario") == 0 || options.output.empty()) {
    throw InputError("SCENARIO and --output BAG are needed; see true_disparity --help");
  }
  if (!(options.step_px >= 0.0)) throw InputError("--step-px must be 0 or more");
  options.scenario = ros_io::scenarioFile(values["scenario"].as<std::string>());
  return options;
}

/// Disparity of every pixel of the rectified left image, CV_32FC1.
cv::Mat disparityMap(const sim::Simulation& simulation, const sim::Scene& scene, double time_s,
                     double step_px) {
  const sim::CameraCalibration& left = simulation.calibration(sim::Side::kLeft);
  const double f = left.P(0, 0), baseline_m = simulation.calibration(sim::Side::kRight).offsetX_m();
  const Eigen::Isometry3d T_world_camera =
      simulation.trajectory().pose(time_s) * simulation.scenario().rig.T_base_camera();
  cv::Mat map(left.height, left.width, CV_32FC1);
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.cols; ++column) {
      const Eigen::Vector3d ray((column - left.P(0, 2)) / f, (row - left.P(1, 2)) / left.P(1, 1), 1.0);
      const double depth_m =
          scene.castRay(T_world_camera.translation(), T_world_camera.linear() * ray, time_s);
      double disparity_px = f * baseline_m / depth_m;
      if (step_px > 0.0) disparity_px = step_px * std::round(disparity_px / step_px);
      map.at<float>(row, column) = static_cast<float>(disparity_px);
    }
  }
  return map;
}

int run(int argc, char** argv) {
  const auto options = parse(argc, argv);
  if (!options) return 0;
  const sim::Simulation simulation(sim::loadScenario(options->scenario, options->overrides),
                                   sim::loadStereoCalibration(ros_io::thesisCalibrationFolder()), 1);
  if (simulation.scenario().calibration_error.scale != 0.0) {
    throw InputError(
        "calibration_error.scale is set: cameras that are not as calibrated have no true disparity map");
  }
  const sim::Scene scene(simulation.scenario().scene);
  const ros::Time start(1000000000, 0);  // as simulate
  ros_io::BagFile bag(options->output);
  for (const sim::PairInstants& pair : simulation.pairs()) {
    if (pair.left_s != pair.right_s) {
      throw InputError("the cameras of this drive do not take their images at the same time");
    }
    stereo_msgs::DisparityImage message;
    message.header.stamp = start + ros::Duration(pair.left_s);
    message.header.frame_id = ros_io::frames::kLeftOptical;
    message.f = static_cast<float>(simulation.calibration(sim::Side::kLeft).P(0, 0));
    message.T = static_cast<float>(simulation.calibration(sim::Side::kRight).offsetX_m());
    cv_bridge::CvImage(message.header, "32FC1",
                       disparityMap(simulation, scene, pair.left_s, options->step_px))
        .toImageMsg(message.image);
    bag.write("camera/disparity", message.header.stamp, message);
  }
  bag.commit();
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("true_disparity", stereo_nav::tools::run, argc, argv);
}
