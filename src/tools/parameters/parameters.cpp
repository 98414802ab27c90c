// Prints the reference of all parameters, docs/parameters.md, from what the nodes themselves check.
#include "stereo_nav/core/parameters.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <string>

#include "nodes/imu_bridge/imu_bridge_node.h"
#include "nodes/recorder/recorder_node.h"
#include "nodes/rig_transforms/rig_transforms_params.h"
#include "nodes/simulator/simulator_node.h"
#include "nodes/visual_odometry/visual_odometry_params.h"
#include "ros/capture_setup.h"
#include "ros/rig.h"
#include "ros/stereo_processing.h"
#include "stereo_nav/odometry/method/odometry_config.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

const char* const kIntroduction = R"(# Parameters

Printed by `rosrun stereo_nav parameters` from what the nodes check; a test holds this page to it. An unknown name, a wrong
type or a value out of range ends the node with a message that names the parameter, the value and what is allowed.

A node takes its values from, each going before the one ahead of it: the defaults below; the file `~config` (a file of
`config/`); its section of the rig file `~rig`; its private namespace on the parameter server, into which `_NAME:=VALUE`
among its arguments goes. The launch files hand over the paths as arguments, so that a node that is started again after the
master has gone reads the same values. A dot stands for a level in a file and for `/` on the parameter server.
**Live** marks what dynamic_reconfigure changes on the running node.
)";

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

template <class Params>
void printTable(const Params& params, const std::vector<std::string>& live = {}) {
  std::cout << "\n| name | type | default | range | unit | meaning |\n|---|---|---|---|---|---|\n";
  for (ParameterDoc doc : documentParameters(params)) {
    replaceAll(doc.range, " | ", ", ");
    const bool is_live = std::find(live.begin(), live.end(), doc.name) != live.end();
    std::cout << "| `" << doc.name << "` | " << doc.type << " | " << doc.default_value << " | " << doc.range
              << " | " << doc.unit << " | " << doc.doc << (is_live ? ". **Live**" : "") << " |\n";
  }
}

void printSensors() {
  std::cout
      << "\n## The rig file\nSections `cameras` (as `stereo_capture`), `imu` (as `imu_bridge`), `disparity` "
         "(as "
         "`stereo_image_proc/disparity`), all below, and `mounting`: where the sensors sit in `base_link`.\n";
  printTable(ros_io::Mounting());
  std::cout << "\n## `stereo_capture`\nBeside these the maps `controls`, `left.controls` and "
               "`right.controls`: any V4L2 "
               "control by its name, a whole number, true or false; and `disparity_config`, the file of the "
               "next but "
               "one table.\n";
  printTable(ros_io::StereoCaptureParams(), {"max_skew_s", "exposure_ms", "gain"});
  std::cout << "\n## `imu_bridge`\n";
  printTable(ros_io::ImuBridgeParams(), {"tilt_stddev_rad", "yaw_stddev_rad", "angular_velocity_stddev_rad_s",
                                         "linear_acceleration_stddev_m_s2"});
  std::cout << "\n## `stereo_image_proc/disparity`\n`config/disparity.yaml`, also read by `evaluate`. All of "
               "them can be "
               "changed live by the nodelet's own dynamic_reconfigure.\n";
  printTable(ros_io::DisparityParams());
}

void printOdometry() {
  std::cout << "\n## `visual_odometry`, node and nodelet\n";
  printTable(nodes::VisualOdometryParams(),
             {"publish_tf", "path_spacing_m", "input_timeout_s", "uncertainty.min_translation_sigma_m",
              "uncertainty.min_rotation_sigma_rad", "uncertainty.lost_speed_m_s",
              "uncertainty.lost_turn_rate_rad_s"});
  std::cout << "\n### The odometry's own\n`config/vo.yaml` and files like it (`~config`), `~vo` on the "
               "parameter server, "
               "also read by `evaluate`.\n";
  printTable(odometry::OdometryConfig());
}

void printOthers() {
  std::cout << "\n## `rig_transforms`\nPublishes the mounting of the rig file `~rig` as static transforms "
               "and checks all "
               "of the file.\n";
  printTable(nodes::RigTransformsParams());
  std::cout << "\n## `recorder`\n";
  printTable(nodes::RecorderParams());
  std::cout
      << "\n## `simulator`\nBeside these `rig`, whose calibration and mounting the simulated sensors have, "
         "and "
         "`disparity_config`. `rosrun stereo_nav simulate --parameters` lists what a scenario may hold.\n";
  printTable(nodes::SimulatorParams());
}

int run(int argc, char** /*argv*/) {
  if (argc > 1) {
    std::cout << "usage: parameters\nPrints every parameter of every node as Markdown: docs/parameters.md\n";
    return 0;
  }
  std::cout << kIntroduction;
  printSensors();
  printOdometry();
  printOthers();
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("parameters", stereo_nav::tools::run, argc, argv);
}
