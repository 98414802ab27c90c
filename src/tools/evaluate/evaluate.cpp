// Runs the odometry on a recording, without a master, and writes trajectory, figures and report.
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>

#include "core/atomic_file.h"
#include "stereo_nav/eval/report.h"
#include "tools/common/program.h"
#include "tools/evaluate/evaluate_options.h"
#include "tools/evaluate/evaluate_run.h"

namespace stereo_nav::tools {
namespace {

void showProgress(std::size_t done, std::size_t all) {
  if (isatty(STDERR_FILENO) == 0) return;
  std::fprintf(stderr, "\r%zu of %zu frames%s", done, all, done == all ? "\n" : "");
}

void printValue(const char* name, double value, const char* unit) {
  if (std::isnan(value)) {
    std::printf("  %-28s unknown\n", name);
  } else {
    std::printf("  %-28s %.4g %s\n", name, value, unit);
  }
}

void printSummary(const eval::EvaluationSummary& summary, const eval::TimingSummary& timing,
                  std::size_t unpaired) {
  std::printf("%s with %s\n", summary.input.c_str(), summary.config.c_str());
  std::printf("  %-28s %zu, %zu lost\n", "frames", summary.frames, summary.frames_lost);
  if (unpaired != 0)
    std::printf("  %-28s %zu (no partner within half a period)\n", "images without a pair", unpaired);
  printValue("path", summary.path_length_m, "m");
  printValue("ATE (RMSE, SE(3) aligned)", summary.ate_rmse_m, "m");
  printValue("relative translation error", summary.rpe_translation_percent, "%");
  printValue("relative rotation error", summary.rpe_rotation_deg_per_m, "deg/m");
  printValue("error at the end", summary.end_error_percent, "% of the path");
  printValue("RMSE x", summary.rmse_x_m, "m");
  printValue("RMSE y", summary.rmse_y_m, "m");
  std::printf("  %-28s %.1f features, %.1f inliers\n", "mean per frame", summary.features_mean,
              summary.inliers_mean);
  std::printf("  %-28s %.2f ms median, %.2f ms p95\n", "odometry per frame", timing.median_ms, timing.p95_ms);
  if (!std::isnan(timing.disparity_median_ms))
    printValue("disparity per frame", timing.disparity_median_ms, "ms");
}

void writeResults(const EvaluateOptions& options, const EvaluationRun& run) {
  const eval::Evaluation evaluation = eval::evaluate(run.input);
  const eval::TimingSummary timing = eval::summariseTiming(run.timings);
  const std::string folder = options.output + "/";
  writeFileAtomically(folder + "trajectory.tum", toTum(eval::estimatedTrajectory(run.input)));
  writeFileAtomically(folder + "trajectory.kitti", toKitti(eval::cameraTrajectory(run.input)));
  writeFileAtomically(folder + "summary.json", eval::toJson(evaluation.summary));
  writeFileAtomically(folder + "frames.csv", eval::toCsv(evaluation.frames));
  writeFileAtomically(folder + "timing.json", eval::toJson(timing));
  const auto warning = eval::writeReport(options.output, evaluation, run.input, timing);
  printSummary(evaluation.summary, timing, run.unpaired_images);
  if (warning) std::fprintf(stderr, "evaluate: %s\n", warning->c_str());
  std::printf("results in %s\n", options.output.c_str());
}

int run(int argc, char** argv) {
  const auto options = parseEvaluateOptions(argc, argv);
  if (!options) return 0;
  { const AtomicFile writable(options->output + "/summary.json"); }  // before the work, not after it
  writeResults(*options, runEvaluation(*options, showProgress));
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("evaluate", stereo_nav::tools::run, argc, argv);
}
