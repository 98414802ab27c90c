#include "stereo_nav/eval/timing.h"

#include <algorithm>
#include <cmath>

#include "core/statistics.h"
#include "eval/json_text.h"

namespace stereo_nav::eval {
namespace {

using Samples = std::vector<std::pair<std::string, std::vector<double>>>;

std::vector<double>& samplesOf(Samples& samples, const std::string& stage) {
  const auto found =
      std::find_if(samples.begin(), samples.end(), [&](const auto& entry) { return entry.first == stage; });
  if (found != samples.end()) return found->second;
  samples.emplace_back(stage, std::vector<double>());
  return samples.back().second;
}

}  // namespace

TimingSummary summariseTiming(const std::vector<FrameTiming>& frames) {
  std::vector<double> frame_ms;
  std::vector<double> disparity_ms;
  Samples stages_ms;
  for (const auto& frame : frames) {
    frame_ms.push_back(frame.frame_ms);
    if (std::isfinite(frame.disparity_ms)) disparity_ms.push_back(frame.disparity_ms);
    for (const auto& [stage, ms] : frame.stages_ms) samplesOf(stages_ms, stage).push_back(ms);
  }
  TimingSummary summary{quantile(frame_ms, 0.5),
                        quantile(frame_ms, 0.95),
                        quantile(frame_ms, 0.99),
                        quantile(frame_ms, 1.0),
                        {},
                        quantile(disparity_ms, 0.5)};
  for (const auto& [stage, ms] : stages_ms) summary.stage_medians_ms.emplace_back(stage, quantile(ms, 0.5));
  return summary;
}

std::string toJson(const TimingSummary& timing) {
  JsonObject frame_time;
  frame_time.add("median", timing.median_ms);
  frame_time.add("p95", timing.p95_ms);
  frame_time.add("p99", timing.p99_ms);
  frame_time.add("max", timing.max_ms);
  JsonObject stage_time;
  for (const auto& [stage, ms] : timing.stage_medians_ms) stage_time.add(stage, ms);
  JsonObject json;
  json.add("frame_time_ms", frame_time);
  json.add("stage_time_ms", stage_time);
  json.add("disparity_time_ms", timing.disparity_median_ms);
  return json.text() + "\n";
}

}  // namespace stereo_nav::eval
