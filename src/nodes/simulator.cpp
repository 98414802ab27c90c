// A simulated robot at real time, in place of stereo_capture and imu_bridge.
#include <exception>

#include "package_files.h"
#include "stereo_nav/nodes/simulator_node.h"
#include "stereo_nav/ros_io/parameter_server.h"

namespace stereo_nav::nodes {
namespace {

/// `~scenario` (file or name), `~calibration` (folder, default the thesis' rig), `~set` (list of NAME=VALUE
/// that change the scenario), and the simulator's own.
void run() {
  ros::NodeHandle node, private_node("~");
  SimulatorParams params;
  ros_io::readParameters(private_node, {"scenario", "calibration", "set"}, params);
  const auto calibration = private_node.param<std::string>("calibration", tools::thesisCalibrationFolder());
  const auto overrides = private_node.param<std::vector<std::string>>("set", {});
  const auto scenario = private_node.param<std::string>("scenario", "arena");
  const sim::Simulation simulation(sim::loadScenario(tools::scenarioFile(scenario), overrides),
                                   sim::loadStereoCalibration(calibration),
                                   static_cast<std::uint64_t>(params.seed));
  SimulatorNode(node, simulation, params).run();
}

}  // namespace
}  // namespace stereo_nav::nodes

int main(int argc, char** argv) {
  ros::init(argc, argv, "simulator");
  try {
    stereo_nav::nodes::run();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 2;
  }
  return 0;
}
