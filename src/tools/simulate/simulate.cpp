// Records a drive through a simulated world as a bag.
#include <unistd.h>

#include <cstdio>
#include <exception>

#include "core/atomic_file.h"
#include "kinematics/drive_file.h"
#include "tools/common/program.h"
#include "tools/simulate/driven_bag.h"
#include "tools/simulate/simulate_options.h"
#include "tools/simulate/simulated_bag.h"

namespace stereo_nav::tools {
namespace {

void showProgress(std::size_t done, std::size_t all) {
  if (isatty(STDERR_FILENO) == 0 && done != all) return;
  std::fprintf(stderr, "\r%zu of %zu pairs%s", done, all, done == all ? "\n" : "");
}

/// Mounting and devices are those of the rig file.
void driveByCommands(const SimulateOptions& options, sim::Scenario scenario,
                     const sim::StereoCalibrationPair& calibration, const SimulatedBagOptions& bag) {
  const RigFile rig = RigFile::load(options.rig);
  const Mounting mounting = rig.mounting();
  scenario.rig.camera = mounting.camera;
  const ros_io::DrivenDevices devices = ros_io::readDrivenDevices(rig);
  sim::DrivenSimulation simulation(scenario, devices.rig, calibration, options.seed);
  if (!options.true_rig.empty())
    writeFileAtomically(options.true_rig, kinematics::driveSection(simulation.trueWheels()));
  writeDrivenBag(options.output, simulation, devices, mounting.imu.T_base_sensor(),
                 readVelocities(options.commands), bag);
}

int run(int argc, char** argv) {
  const auto options = parseSimulateOptions(argc, argv);
  if (!options) return 0;
  sim::Scenario scenario = sim::loadScenario(options->scenario, options->overrides);
  if (!options->rig.empty()) scenario.drive = kinematics::readDrive(RigFile::load(options->rig));
  const sim::StereoCalibrationPair calibration = sim::loadStereoCalibration(options->calibration);
  const SimulatedBagOptions bag{options->duration_s, options->threads, options->images, options->compress};
  if (!options->commands.empty()) {
    driveByCommands(*options, scenario, calibration, bag);
    return 0;
  }
  const sim::Simulation simulation(scenario, calibration, options->seed);
  if (!options->true_rig.empty())
    writeFileAtomically(options->true_rig, kinematics::driveSection(simulation.trueWheels()));
  writeSimulatedBag(options->output, simulation, bag, showProgress);
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("simulate", stereo_nav::tools::run, argc, argv);
}
