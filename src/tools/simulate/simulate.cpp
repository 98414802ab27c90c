// Records a drive through a simulated world as a bag.
#include <unistd.h>

#include <cstdio>
#include <exception>

#include "core/atomic_file.h"
#include "kinematics/drive_file.h"
#include "tools/common/program.h"
#include "tools/simulate/simulate_options.h"
#include "tools/simulate/simulated_bag.h"

namespace stereo_nav::tools {
namespace {

void showProgress(std::size_t done, std::size_t all) {
  if (isatty(STDERR_FILENO) == 0 && done != all) return;
  std::fprintf(stderr, "\r%zu of %zu pairs%s", done, all, done == all ? "\n" : "");
}

int run(int argc, char** argv) {
  const auto options = parseSimulateOptions(argc, argv);
  if (!options) return 0;
  sim::Scenario scenario = sim::loadScenario(options->scenario, options->overrides);
  if (!options->rig.empty()) scenario.drive = kinematics::readDrive(RigFile::load(options->rig));
  const sim::Simulation simulation(scenario, sim::loadStereoCalibration(options->calibration), options->seed);
  if (!options->true_rig.empty())
    writeFileAtomically(options->true_rig, kinematics::driveSection(simulation.trueWheels()));
  writeSimulatedBag(options->output, simulation,
                    {options->duration_s, options->threads, options->images, options->compress},
                    showProgress);
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("simulate", stereo_nav::tools::run, argc, argv);
}
