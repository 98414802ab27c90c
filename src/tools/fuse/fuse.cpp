// Runs the filter over the topics of a bag, without a master, and writes trajectory, figures and report.
#include <algorithm>
#include <cstdio>

#include "core/atomic_file.h"
#include "stereo_nav/core/trajectory.h"
#include "stereo_nav/eval/report.h"
#include "tools/common/program.h"
#include "tools/fuse/fuse_options.h"
#include "tools/fuse/fuse_run.h"
#include "tools/fuse/fusion_report.h"

namespace stereo_nav::tools {
namespace {

void printEnd(const FuseRun& run) {
  if (run.input.frames.empty()) return;
  const Eigen::Vector3d end = run.input.frames.back().T_odom_base->translation();
  std::printf("  position at the end %.4f %.4f %.4f m\n", end.x(), end.y(), end.z());
}

int run(int argc, char** argv) {
  const auto options = parseFuseOptions(argc, argv);
  if (!options) return 0;
  { const AtomicFile writable(options->output + "/summary.json"); }  // before the work, not after it
  FuseRun run = runFusion(*options);
  const eval::Evaluation evaluation = eval::evaluate(run.input);
  const eval::TimingSummary timing = eval::summariseTiming(run.timings);
  const PoseErrors errors = poseErrors(run);
  const std::string folder = options->output + "/";
  writeFileAtomically(folder + "trajectory.tum", toTum(eval::estimatedTrajectory(run.input)));
  writeFileAtomically(folder + "summary.json", eval::toJson(evaluation.summary));
  writeFileAtomically(folder + "frames.csv", eval::toCsv(evaluation.frames));
  writeFileAtomically(folder + "fusion.json", fusionJson(run, errors));
  writeFileAtomically(folder + "timing.json", eval::toJson(timing));
  const auto warning = eval::writeReport(options->output, evaluation, run.input, timing);
  std::printf("%s with %s, %zu measurements\n", run.input.input.c_str(), run.input.config.c_str(),
              run.measurements);
  printFusion(run, errors);
  printEnd(run);
  std::printf("  filter per measurement %.1f us median, %.1f us p99\n", 1e3 * timing.median_ms,
              1e3 * timing.p99_ms);
  for (const std::string& text : run.announcements) std::printf("  said at %s\n", text.c_str());
  for (const std::string& note : run.input.notes) std::fprintf(stderr, "fuse: note: %s\n", note.c_str());
  if (warning) std::fprintf(stderr, "fuse: %s\n", warning->c_str());
  std::printf("results in %s\n", options->output.c_str());
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("fuse", stereo_nav::tools::run, argc, argv);
}
