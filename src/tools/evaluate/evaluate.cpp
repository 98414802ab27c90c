// Runs the odometry on a recording, without a master, and writes trajectory, figures and report.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>

#include "core/atomic_file.h"
#include "eval/losses.h"
#include "eval/truth_frame.h"
#include "stereo_nav/eval/report.h"
#include "tools/common/program.h"
#include "tools/evaluate/evaluate_options.h"
#include "tools/evaluate/evaluate_run.h"
#include "tools/evaluate/laser_run.h"
#ifdef STEREO_NAV_MAPPING
#include "tools/evaluate/mono_run.h"
#endif
#include "tools/evaluate/wheel_run.h"

namespace stereo_nav::tools {
namespace {

constexpr int kMostlyLost = 3;

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

std::string lengthsText(const std::vector<double>& lengths_m) {
  std::string text;
  for (const double length_m : lengths_m) {
    text += fmt::format("{}{:g}", text.empty() ? "% over " : ", ", length_m);
  }
  return text.empty() ? "%" : text + " m";
}

void printErrors(const eval::EvaluationSummary& summary) {
  if (summary.frames_with_ground_truth == 0) {
    std::printf("  no ground truth: the errors are unknown (--ground-truth names a file or a topic)\n");
    return;
  }
  printValue("ATE (RMSE, SE(3) aligned)", summary.ate_rmse_m, "m");
  if (summary.segment_lengths_m.empty()) {
    std::printf("  %-28s unknown: the path is too short for a length of 0.5 m or more\n", "relative errors");
  } else {
    printValue("relative translation error", summary.rpe_translation_percent,
               lengthsText(summary.segment_lengths_m).c_str());
    printValue("relative rotation error", summary.rpe_rotation_deg_per_m, "deg/m");
  }
  printValue("error at the end", summary.end_error_percent, "% of the path");
  printValue("RMSE x", summary.rmse_x_m, "m");
  printValue("RMSE y", summary.rmse_y_m, "m");
}

void printLosses(const std::vector<eval::Loss>& losses) {
  constexpr std::size_t kShown = 10;
  for (std::size_t i = 0; i < std::min(losses.size(), kShown); ++i) {
    std::printf("  lost: %s\n", eval::toText(losses[i]).c_str());
  }
  if (losses.size() > kShown) std::printf("  and %zu more losses, see report.html\n", losses.size() - kShown);
}

/// Of the longest pieces that there are.
void printConsistency(const eval::EvaluationSummary& summary) {
  for (std::size_t k = eval::kNeesIntervals_s.size(); k-- > 0;) {
    const eval::Nees& nees = summary.nees[k];
    if (nees.pairs == 0) continue;
    const std::string name = fmt::format("NEES over {:g} s", eval::kNeesIntervals_s[k]);
    std::printf("  %-28s %.3g, %d expected (%zu pieces)\n", name.c_str(), nees.mean, nees.expected,
                nees.pairs);
    return;
  }
}

void printSegments(const eval::EvaluationSummary& summary) {
  for (const eval::SegmentErrors& errors : summary.segments) {
    std::printf("  errors over %-16g %.4g %%, %.4g deg/m (%zu pieces)\n", errors.length_m,
                errors.translation_percent, errors.rotation_deg_per_m, errors.pairs);
  }
}

void printSummary(const eval::Evaluation& evaluation, const eval::TimingSummary& timing, std::size_t unpaired,
                  EvaluatedMethod method) {
  const eval::EvaluationSummary& summary = evaluation.summary;
  std::printf("%s with %s\n", summary.input.c_str(), summary.config.c_str());
  std::printf("  %-28s %zu, %zu lost\n", "frames", summary.frames, summary.frames_lost);
  printLosses(eval::lossesOf(evaluation.frames));
  if (unpaired != 0)
    std::printf("  %-28s %zu (no partner within half a period)\n", "images without a pair", unpaired);
  printValue("path", summary.path_length_m, "m");
  printErrors(summary);
  printSegments(summary);
  if (method == EvaluatedMethod::kWheel) {
    printConsistency(summary);
    std::printf("  %-28s %.2f us median\n", "odometry per reading", 1e3 * timing.median_ms);
    return;
  }
  if (method == EvaluatedMethod::kLaser) {
    printConsistency(summary);
    std::printf("  %-28s %.1f points, %.1f on the map\n", "mean per scan", summary.features_mean,
                summary.inliers_mean);
    std::printf("  %-28s %.3f ms median, %.3f ms p99\n", "odometry per scan", timing.median_ms,
                timing.p99_ms);
    return;
  }
  if (method == EvaluatedMethod::kMono) printConsistency(summary);
  std::printf("  %-28s %.1f features, %.1f inliers\n", "mean per frame", summary.features_mean,
              summary.inliers_mean);
  std::printf("  %-28s %.2f ms median, %.2f ms p95\n", "odometry per frame", timing.median_ms, timing.p95_ms);
  if (!std::isnan(timing.disparity_median_ms))
    printValue("disparity per frame", timing.disparity_median_ms, "ms");
}

/// Exit status: 3 when most of the recording has no pose.
int writeResults(const EvaluateOptions& options, EvaluationRun run) {
  const eval::Evaluation evaluation = eval::evaluate(run.input);
  if (const auto frame = eval::wrongTruthFrame(run.input, evaluation.summary))
    run.input.notes.push_back(*frame);
  const eval::TimingSummary timing = eval::summariseTiming(run.timings);
  const std::string folder = options.output + "/";
  writeFileAtomically(folder + "trajectory.tum", toTum(eval::estimatedTrajectory(run.input)));
  writeFileAtomically(folder + "trajectory.kitti", toKitti(eval::cameraTrajectory(run.input)));
  writeFileAtomically(folder + "summary.json", eval::toJson(evaluation.summary));
  writeFileAtomically(folder + "frames.csv", eval::toCsv(evaluation.frames));
  writeFileAtomically(folder + "timing.json", eval::toJson(timing));
  const auto warning = eval::writeReport(options.output, evaluation, run.input, timing);
  printSummary(evaluation, timing, run.unpaired_images, options.method);
  for (const std::string& note : run.input.notes) std::fprintf(stderr, "evaluate: note: %s\n", note.c_str());
  if (warning) std::fprintf(stderr, "evaluate: %s\n", warning->c_str());
  std::printf("results in %s\n", options.output.c_str());
  const eval::EvaluationSummary& summary = evaluation.summary;
  if (2 * summary.frames_lost <= summary.frames) return 0;
  std::fprintf(stderr,
               "evaluate: %zu of %zu frames are lost, more than half: the trajectory does not show the drive "
               "(exit status 3)\n",
               summary.frames_lost, summary.frames);
  return kMostlyLost;
}

int run(int argc, char** argv) {
  const auto options = parseEvaluateOptions(argc, argv);
  if (!options) return 0;
  { const AtomicFile writable(options->output + "/summary.json"); }  // before the work, not after it
  switch (options->method) {
    case EvaluatedMethod::kWheel:
      return writeResults(*options, runWheelEvaluation(*options));
    case EvaluatedMethod::kLaser:
      return writeResults(*options, runLaserEvaluation(*options));
#ifdef STEREO_NAV_MAPPING
    case EvaluatedMethod::kMono:
      return writeResults(*options, runMonoEvaluation(*options, showProgress));
#endif
    default:
      break;
  }
  return writeResults(*options, runEvaluation(*options, showProgress));
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("evaluate", stereo_nav::tools::run, argc, argv);
}
