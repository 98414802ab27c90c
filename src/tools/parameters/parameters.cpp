// Prints the reference of all parameters, docs/parameters.md, from what the nodes themselves check.
#include "stereo_nav/core/parameters.h"

#include <iostream>
#include <string>

#include "core/rig_file.h"
#include "estimation/ekf/fusion_params.h"
#include "kinematics/drive_params.h"
#ifdef STEREO_NAV_MAPPING
#include "mapping/loop/loop_params.h"
#include "mapping/mono/mono_params.h"
#endif
#ifdef STEREO_NAV_NAVIGATION
#include "navigation/planner/planner_params.h"
#endif
#include "nodes/cmd_vel_mux/cmd_vel_mux_node.h"
#include "nodes/imu_bridge/imu_bridge_node.h"
#include "nodes/laser_odometry/laser_odometry_node_params.h"
#include "nodes/map_image_server/map_image_server_params.h"
#ifdef STEREO_NAV_NAVIGATION
#include "nodes/navigator/navigator_node_params.h"
#include "nodes/navigator/send_path_params.h"
#include "nodes/obstacle_grid/obstacle_grid_params.h"
#endif
#include "nodes/range_correction/range_correction_params.h"
#include "nodes/recorder/recorder_node.h"
#include "nodes/rig_transforms/rig_transforms_params.h"
#include "nodes/simulator/simulator_params.h"
#include "nodes/teleop/key_driver.h"
#include "nodes/visual_odometry/visual_odometry_params.h"
#include "nodes/wheel_odometry/wheel_odometry_node_params.h"
#include "ros/base_bridge_params.h"
#include "ros/capture_setup.h"
#include "ros/laser_bridge_params.h"
#include "ros/range_bridge_params.h"
#include "ros/stereo_processing.h"
#include "stereo_nav/odometry/method/odometry_config.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

const char* const kIntroduction = R"(# Parameters

Printed by `rosrun stereo_nav parameters` from the descriptions by which the nodes check their parameters; a test compares
them. An unknown name, a wrong type or a value out of range ends the node with a message that names the parameter, the value
and what is allowed.

A node reads its values from these places, where a later one overrides those before it: the defaults below; the file
`~config` (a file of `config/`); its section of the rig file `~rig`; its private namespace on the parameter server, which
the argument `_NAME:=VALUE` sets. The launch files pass the paths as arguments, so that a node that is started again after
the master has ended reads the same values. A dot stands for a level in a file and for `/` on the parameter server.
**Live** marks what dynamic_reconfigure changes on the running node.
)";

void replaceAll(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

template <class Params>
void printTable(const Params& params) {
  std::cout << "\n| name | type | default | range | unit | meaning |\n|---|---|---|---|---|---|\n";
  for (ParameterDoc doc : documentParameters(params)) {
    replaceAll(doc.range, " | ", ", ");
    std::cout << "| `" << doc.name << "` | " << doc.type << " | " << doc.default_value << " | " << doc.range
              << " | " << doc.unit << " | " << doc.doc << (doc.live ? ". **Live**" : "") << " |\n";
  }
}

void printHeading(const std::string& title, const std::string& text = "") {
  std::cout << "\n" << title << "\n" << text << (text.empty() ? "" : "\n");
}

void printSensors() {
  printHeading(
      "## The rig file",
      "Sections `cameras` (as `stereo_capture`), `imu` (as `imu_bridge`), `laser` (as `laser_bridge`), "
      "`range_finders` (as `range_bridge`), `disparity` (as "
      "`stereo_image_proc/disparity`), `wheel_odometry` (as `wheel_odometry`, without its own), `uncertainty` (as "
      "`visual_odometry`), `base` (as `base_bridge`), all below, and `mounting`: where the sensors sit in "
      "`base_link`. Servos and range finders, which are in lists, have their `mounting` there.");
  printTable(Mounting());
  printHeading(
      "### Section `drive`",
      "`wheels`, how many there are, and for each of them a section `wheel_1`, `wheel_2`, ... as here; radius_m "
      "and pulses_per_turn have no default.");
  printTable(kinematics::WheelParams());
  printHeading(
      "## `stereo_capture`",
      "Beside these the maps `controls`, `left.controls` and `right.controls`: any V4L2 control by "
      "its name, a whole number, true or false; and `disparity_config`, the file of the next but one "
      "table.");
  printTable(ros_io::StereoCaptureParams());
  printHeading("## `imu_bridge`");
  printTable(ros_io::ImuBridgeParams());
  printHeading("## `laser_bridge`", "`config/laser.yaml`, and section `laser` of the rig file.");
  printTable(ros_io::LaserBridgeParams());
  printHeading(
      "## `range_bridge`",
      "`config/ranges.yaml`, and section `range_finders` of the rig file: `by_id_directory`, `finders`, how many there "
      "are, and for each of them a section `finder_1`, `finder_2`, ... as here.");
  printTable(ros_io::RangeFinderParams());
  printHeading("## `stereo_image_proc/disparity`",
               "`config/disparity.yaml`, also read by `evaluate`. All of them can be changed live by the "
               "nodelet's own dynamic_reconfigure.");
  printTable(ros_io::DisparityParams());
}

void printBase() {
  printHeading(
      "## `base_bridge`",
      "`config/base.yaml`; section `base` of the rig file, which also holds for each of `joints`, `ranges`, "
      "`switches` and `actuators` a section `joint_1`, `range_1`, `switch_1`, `actuator_1`, ... as below. The "
      "wheels are the section `drive` of `~rig`.");
  printTable(ros_io::BaseBridgeParams());
  printHeading("### A servo, `joint_N`");
  printTable(ros_io::BaseJointParams());
  printHeading("### A range finder, `range_N`");
  printTable(ros_io::BaseRangeParams());
  printHeading("### A switch or an actuator, `switch_N`, `actuator_N`");
  printTable(ros_io::BaseNameParams());
  printHeading("## `cmd_vel_mux`");
  printTable(nodes::CmdVelMuxParams());
  printHeading("## `teleop`");
  printTable(nodes::TeleopParams());
}

void printFusion() {
  printHeading(
      "## `ekf_localization`, node and nodelet, and `fuse`",
      "Files of `config/fusion`, or of robot_localization ([fusion.md](fusion.md)). Beside these: `odomN`, `poseN`, `twistN`, "
      "`imuN`, `fixN`, the topic of a sensor; `odomN_config`, 15 times true or false; `process_noise_covariance` and "
      "`initial_estimate_covariance`, 225 numbers; `initial_state`, 15 numbers.");
  printTable(estimation::FusionParams());
  printHeading("### A sensor, `odomN_...`, `poseN_...`, `twistN_...`, `imuN_...`, `fixN_...`");
  printTable(estimation::FusedSensorParams());
}

void printOdometry() {
  printHeading("## `visual_odometry`, node and nodelet");
  printTable(nodes::VisualOdometryParams());
  printHeading("### The odometry's own",
               "`config/vo.yaml` and files like it (`~config`), `~vo` on the parameter server, also read by "
               "`evaluate`.");
  printTable(odometry::OdometryConfig());
}

void printOthers() {
  printHeading(
      "## `wheel_odometry`",
      "Its own, and then those of the odometry: `config/wheel.yaml` and files like it (`~config`), also read by "
      "`evaluate --method wheel` and `calibrate_wheels`. The wheels are the section `drive` of `~rig`.");
  printTable(nodes::WheelOdometryNodeParams());
  printHeading("## `laser_odometry`, node and nodelet",
               "Its own, and then those of the odometry: `config/laser_odometry.yaml` and files like it "
               "(`~config`), also read by `evaluate --method laser`.");
  printTable(nodes::LaserOdometryNodeParams());
#ifdef STEREO_NAV_NAVIGATION
  printHeading("## Path planning", "`config/planner.yaml` and files like it, read by `plan`.");
  printTable(navigation::PlannerParams());
  printHeading("## `obstacle_grid`, node and nodelet",
               "`config/obstacles.yaml` and files like it (`~config`).");
  printTable(nodes::ObstacleGridParams());
  printHeading("## `navigator`", "`config/navigator.yaml` and files like it (`~config`).");
  printTable(nodes::NavigatorNodeParams());
  printHeading("## `send_path`", "Sends a path from a file to the navigator.");
  printTable(nodes::SendPathParams());
#endif
#ifdef STEREO_NAV_MAPPING
  printHeading("## Recognising places",
               "`config/loop.yaml` and files like it, read by `find_loops` and `build_map`.");
  printTable(mapping::LoopParams());
  printHeading("## One camera",
               "`config/mono_slam.yaml` and files like it, read by `evaluate --method mono`.");
  printTable(mapping::MonoParams());
#endif
  printHeading("## `rig_transforms`",
               "Publishes the mounting of the rig file `~rig` as static transforms and checks all of the "
               "file.");
  printTable(nodes::RigTransformsParams());
  printHeading("## `map_image_server`");
  printTable(nodes::MapImageServerParams());
  printHeading("## `range_correction`", "`config/range_correction.yaml` and files like it (`~config`).");
  printTable(nodes::RangeCorrectionParams());
  printHeading("## `recorder`");
  printTable(nodes::RecorderParams());
  printHeading(
      "## `simulator`",
      "Beside these `rig`, whose calibration and mounting the simulated sensors have, and "
      "`disparity_config`. `rosrun stereo_nav simulate --parameters` lists what a scenario may hold.");
  printTable(nodes::SimulatorParams());
}

int run(int argc, char** /*argv*/) {
  if (argc > 1) {
    std::cout << "usage: parameters\nPrints every parameter of every node as Markdown: docs/parameters.md\n";
    return 0;
  }
  std::cout << kIntroduction;
  printSensors();
  printBase();
  printOdometry();
  printFusion();
  printOthers();
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("parameters", stereo_nav::tools::run, argc, argv);
}
