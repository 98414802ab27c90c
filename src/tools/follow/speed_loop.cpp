// Runs a loop of speed on the drive on which such loops are measured.
#include "navigation/control/speed_loop.h"

#include <fmt/format.h>

#include <cstdio>

#include "core/atomic_file.h"
#include "navigation/control/as_published.h"
#include "navigation/control/pid.h"
#include "tools/common/command_line.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

control::SpeedController controllerOf(bool as_published) {
  if (as_published) {
    return [pid = control::PublishedPid({})](double wanted, double measured, double period_s) mutable {
      return pid.update(wanted, measured, period_s);
    };
  }
  control::PidParams params;
  params.min_output = 0.0;
  params.max_output = 1200.0;
  return [pid = control::Pid(params)](double wanted, double measured, double period_s) mutable {
    return pid.update(wanted, measured, period_s);
  };
}

int run(int argc, char** argv) {
  bool as_published = false;
  std::string output;
  po::options_description visible(helpHeading(
      "usage: speed_loop [options]",
      "Runs a controller of speed on a first-order drive (0.15 s, 50 Hz, commands up to 1200 mm/s): from rest to 900 mm/s, held "
      "for 0.6 s, then to 0; prints a row of a table."));
  visible.add_options()                                                                         //
      ("help,h", "this text")                                                                   //
      ("as-published", po::bool_switch(&as_published), "the loop of the swerve robot of 2024")  //
      ("output", po::value(&output), "CSV file with the wanted speed, the command and the speed");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "", values)) return 0;
  const control::SpeedLoopRun run = control::runSpeedLoop(controllerOf(as_published));
  std::printf(
      "| loop | overshoot mm/s | settled s | settled after the block s | 2 s after it was asked for 0, mm/s |\n|---|---|---|---|---|\n"
      "| %s | %.1f | %.2f | %.2f | %.1f |\n",
      as_published ? "as published" : "PID", run.overshoot_mm_per_s, run.settled_s, run.settled_after_block_s,
      run.last_speed_mm_per_s);
  if (output.empty()) return 0;
  std::string csv = "time_s,wanted_mm_per_s,command_mm_per_s,speed_mm_per_s\n";
  for (const auto& sample : run.samples)
    csv += fmt::format("{:.2f},{:.1f},{:.2f},{:.2f}\n", sample.time_s, sample.wanted, sample.command,
                       sample.speed);
  writeFileAtomically(output, csv);
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("speed_loop", stereo_nav::tools::run, argc, argv);
}
