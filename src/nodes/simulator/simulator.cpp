// A robot simulated in real time, in place of stereo_capture and imu_bridge.
#include <filesystem>
#include <sstream>

#include "core/rig_file.h"
#include "kinematics/drive_file.h"
#include "nodes/simulator/driven_node.h"
#include "nodes/simulator/simulator_node.h"
#include "ros/calibration_url.h"
#include "ros/capture_setup.h"
#include "ros/image_proc_loader.h"
#include "ros/node_program.h"
#include "ros/package_files.h"
#include "ros/parameter_server.h"

namespace stereo_nav::nodes {
namespace {

/// The parts of a rig file that the simulated devices use: calibration, mounting and wheels.
struct SimulatedRig {
  sim::StereoCalibrationPair calibration;
  Eigen::Isometry3d T_base_imu = Eigen::Isometry3d::Identity();
  ros_io::DrivenDevices devices;  ///< of a driven robot
};

/// Calibration of one camera of the rig file.
auto loadCalibration(const std::string& url, const std::string& side) {
  const std::string path = ros_io::pathOfUrl(url.empty() ? ros_io::kDefaultCalibrationUrl : url, side);
  if (url.empty() && !std::filesystem::exists(path)) {
    throw ParameterError("the rig file names no calibration of the " + side + " camera, and there is no " +
                         path + "; calibrate (calibrate.launch), or give cameras." + side +
                         ".calibration in the rig file, e.g. package://stereo_nav/config/thesis/" + side +
                         ".yaml");
  }
  return sim::loadCameraCalibration(path);
}

/// Without `~rig`, the thesis' rig with its cameras at the poses of the scenario.
SimulatedRig readRig(const ros::NodeHandle& private_node, bool is_driven, sim::Scenario& scenario) {
  const auto rig = private_node.param<std::string>("rig", "");
  if (rig.empty() && is_driven)
    throw ParameterError("~driven needs ~rig, whose section `drive` says what moves");
  if (rig.empty())
    return {sim::loadStereoCalibration(ros_io::thesisCalibrationFolder()), Eigen::Isometry3d::Identity(), {}};
  ros_io::CaptureSetup setup;
  setup.read({ros_io::rigSource(private_node, rig_sections::kCameras)});
  const RigFile file = RigFile::load(rig);
  const Mounting mounting = file.mounting();
  scenario.rig.camera = mounting.camera;
  if (!file.section(rig_sections::kDrive).IsNull()) scenario.drive = kinematics::readDrive(file);
  return {{loadCalibration(setup.params.left.calibration, "left"),
           loadCalibration(setup.params.right.calibration, "right")},
          mounting.imu.T_base_sensor(),
          is_driven ? ros_io::readDrivenDevices(file) : ros_io::DrivenDevices()};
}

std::vector<std::string> splitSettings(const std::string& text) {
  std::vector<std::string> settings;
  std::istringstream stream(text);
  for (std::string setting; std::getline(stream, setting, ';');) settings.push_back(setting);
  return settings;
}

/// Besides the simulator's own parameters there are the files `~rig` and `~disparity_config`.
int run() {
  ros::NodeHandle node, private_node("~");
  SimulatorParams params;
  ros_io::readParameters(
      {ros_io::serverSource(private_node, {"disparity_config", "num_worker_threads", "diagnostic_period"})},
      params);
  sim::Scenario scenario =
      sim::loadScenario(ros_io::scenarioFile(params.scenario), splitSettings(params.settings));
  const SimulatedRig rig = readRig(private_node, params.driven, scenario);
  std::unique_ptr<ros_io::ImageProcLoader> image_proc;
  if (params.load_image_proc) {
    image_proc = std::make_unique<ros_io::ImageProcLoader>(true, ros_io::readDisparityParams(private_node));
  }
  ros::AsyncSpinner spinner(1);  // for nodelets and diagnostics
  spinner.start();
  if (params.driven) {
    DrivenSimulatorNode(node, {scenario, rig.calibration, rig.devices, rig.T_base_imu}, params).run();
    return 0;
  }
  const sim::Simulation simulation(scenario, rig.calibration, static_cast<std::uint64_t>(params.seed));
  SimulatorNode(node, simulation, params, rig.T_base_imu).run();
  return 0;
}

}  // namespace
}  // namespace stereo_nav::nodes

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "simulator", stereo_nav::nodes::run);
}
