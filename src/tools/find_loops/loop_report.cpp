#include "tools/find_loops/loop_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numeric>

#include "core/angles.h"
#include "core/statistics.h"
#include "eval/json_text.h"

namespace stereo_nav::tools {
namespace {

using mapping::LoopCandidate;

constexpr std::size_t kInTime = 3;  ///< keyframes, the first one of a revisit included

/// What became of each keyframe.
struct Outcome {
  bool revisit = false, recognised = false;
};

bool isRevisit(const LoopRun& run, std::size_t query) {
  for (std::size_t place = 0; place < run.past_end[query]; ++place) {
    if (run.is_same_place(query, place)) return true;
  }
  return false;
}

/// A loop is false if it names a place that cannot be seen from there, or puts the query elsewhere in it.
bool isFalse(const LoopRun& run, const LoopCandidate& candidate) {
  if (!run.true_pose) return !run.is_same_place(candidate.query, candidate.place);
  constexpr double kElsewhere_m = 0.3;
  const auto T_true = run.true_pose(candidate.query, candidate.place);
  return T_true && (candidate.place_query.T.translation() - T_true->translation()).norm() > kElsewhere_m;
}

/// Error of the pose of a verified loop; nothing where the truth is not known, or there is no pose.
struct PoseError {
  double translation_m, rotation_deg, nees;
};
std::optional<PoseError> poseError(const LoopRun& run, const LoopCandidate& candidate) {
  const auto T_true =
      candidate.hasPose() && run.true_pose ? run.true_pose(candidate.query, candidate.place) : std::nullopt;
  if (!T_true) return std::nullopt;
  const Vector6d error = logMotion(candidate.place_query.T.inverse() * *T_true);
  return PoseError{error.head<3>().norm(), error.tail<3>().norm() * kDegPerRad,
                   error.dot(candidate.place_query.covariance.ldlt().solve(error))};
}

void addPoses(const LoopRun& run, LoopFigures& figures) {
  for (const LoopCandidate& candidate : run.candidates) {
    const auto error =
        candidate.accepted() && !isFalse(run, candidate) ? poseError(run, candidate) : std::nullopt;
    if (!error) continue;
    ++figures.posed;
    figures.rms_translation_m += error->translation_m * error->translation_m;
    figures.rms_rotation_deg += error->rotation_deg * error->rotation_deg;
    figures.nees_mean += error->nees;
    figures.worst_translation_m = std::max(figures.worst_translation_m, error->translation_m);
    figures.worst_rotation_deg = std::max(figures.worst_rotation_deg, error->rotation_deg);
  }
  const double count = std::max(1.0, static_cast<double>(figures.posed));
  figures.rms_translation_m = std::sqrt(figures.rms_translation_m / count);
  figures.rms_rotation_deg = std::sqrt(figures.rms_rotation_deg / count);
  figures.nees_mean /= count;
}

void addTruth(const LoopRun& run, LoopFigures& figures) {
  std::vector<Outcome> outcomes(run.names.size());
  for (std::size_t query = 0; query < outcomes.size(); ++query)
    outcomes[query].revisit = isRevisit(run, query);
  std::size_t last_query = run.names.size();
  for (const LoopCandidate& candidate : run.candidates) {
    Outcome& outcome = outcomes[candidate.query];
    const bool is_first = candidate.query != last_query;
    last_query = candidate.query;
    if (is_first && outcome.revisit && run.is_same_place(candidate.query, candidate.place))
      ++figures.first_is_same;
    if (!candidate.accepted()) continue;
    if (isFalse(run, candidate))
      ++figures.false_accepted;
    else
      outcome.recognised = true;
  }
  for (std::size_t query = 0; query < outcomes.size(); ++query) {
    if (!outcomes[query].revisit) continue;
    ++figures.revisits;
    if (outcomes[query].recognised) ++figures.recognised;
    const std::size_t end = std::min(outcomes.size(), query + kInTime);
    if (std::any_of(outcomes.begin() + static_cast<std::ptrdiff_t>(query),
                    outcomes.begin() + static_cast<std::ptrdiff_t>(end),
                    [](const Outcome& outcome) { return outcome.recognised; }))
      ++figures.found_in_time;
  }
}

double meanOf(const std::vector<double>& values) {
  return values.empty()
             ? std::nan("")
             : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void addTimes(const std::string& name, const std::vector<double>& times_ms, eval::JsonObject& json) {
  if (times_ms.empty()) return;
  json.add(name + "_mean_ms", meanOf(times_ms));
  json.add(name + "_median_ms", quantile(times_ms, 0.5));
  json.add(name + "_max_ms", *std::max_element(times_ms.begin(), times_ms.end()));
}

}  // namespace

LoopFigures figuresOf(const LoopRun& run) {
  LoopFigures figures;
  figures.keyframes = run.names.size();
  figures.candidates = run.candidates.size();
  figures.accepted = static_cast<std::size_t>(
      std::count_if(run.candidates.begin(), run.candidates.end(),
                    [](const LoopCandidate& candidate) { return candidate.accepted(); }));
  if (figures.keyframes > 0)
    figures.index_bytes_per_keyframe =
        static_cast<double>(run.index_bytes) / static_cast<double>(figures.keyframes);
  figures.has_truth = static_cast<bool>(run.is_same_place);
  if (figures.has_truth) addTruth(run, figures);
  if (run.true_pose) addPoses(run, figures);
  return figures;
}

std::string toJson(const LoopFigures& figures, const std::string& input) {
  eval::JsonObject json;
  json.add("input", input);
  json.add("keyframes", figures.keyframes);
  json.add("candidates", figures.candidates);
  json.add("accepted", figures.accepted);
  json.add("index_bytes_per_keyframe", figures.index_bytes_per_keyframe);
  if (figures.has_truth) {
    json.add("revisits", figures.revisits);
    json.add("first_is_same", figures.first_is_same);
    json.add("recognised", figures.recognised);
    json.add("found_within_3_keyframes", figures.found_in_time);
    json.add("false_accepted", figures.false_accepted);
  }
  if (figures.posed > 0) {
    json.add("rms_translation_m", figures.rms_translation_m);
    json.add("rms_rotation_deg", figures.rms_rotation_deg);
    json.add("worst_translation_m", figures.worst_translation_m);
    json.add("worst_rotation_deg", figures.worst_rotation_deg);
    json.add("nees_mean", figures.nees_mean);
    json.add("nees_expected", 6);
  }
  return json.text() + "\n";
}

std::string timingJson(const LoopRun& run) {
  eval::JsonObject json;
  addTimes("describing", run.describe_ms, json);
  addTimes("retrieval", run.retrieval_ms, json);
  addTimes("recognition_and_verification", run.loop_ms, json);
  return json.text() + "\n";
}

std::string toCsv(const LoopRun& run) {
  std::string text =
      "query,place,query_name,place_name,score,stage,figure,bound,matches,inliers,drift_chi2,x_m,y_m,z_m,"
      "rx_rad,ry_rad,rz_rad,same_place,error_m,error_deg,nees,reason\n";
  for (const LoopCandidate& candidate : run.candidates) {
    text += fmt::format("{},{},{},{},{:.4f},{},{:.6g},{:.6g},{},{},{:.4g},", candidate.query_id,
                        candidate.place_id, run.names[candidate.query], run.names[candidate.place],
                        candidate.score, mapping::nameOf(candidate.stage), candidate.figure, candidate.bound,
                        candidate.matches, candidate.inliers, candidate.drift_chi2);
    const Eigen::Vector3d turn = logRotation(Eigen::Matrix3d(candidate.place_query.T.linear()));
    const Eigen::Vector3d way = candidate.place_query.T.translation();
    text += fmt::format("{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.5f},", way.x(), way.y(), way.z(), turn.x(),
                        turn.y(), turn.z());
    if (run.is_same_place) text += run.is_same_place(candidate.query, candidate.place) ? "yes" : "no";
    const auto error = poseError(run, candidate);
    text += error
                ? fmt::format(",{:.4f},{:.3f},{:.3g}", error->translation_m, error->rotation_deg, error->nees)
                : std::string(",,,");
    text += fmt::format(",\"{}\"\n", candidate.reason());
  }
  return text;
}

void print(const LoopFigures& figures, const LoopRun& run, const std::string& input) {
  std::printf("%s: %zu keyframes, %zu candidates, %zu loops accepted\n", input.c_str(), figures.keyframes,
              figures.candidates, figures.accepted);
  std::map<std::string, std::size_t> rejected;
  for (const LoopCandidate& candidate : run.candidates) {
    if (!candidate.accepted()) ++rejected[mapping::nameOf(candidate.stage)];
  }
  for (const auto& [stage, count] : rejected) std::printf("  rejected by %-16s %zu\n", stage.c_str(), count);
  if (figures.has_truth) {
    std::printf(
        "  %zu of them see a place again: most similar place right %zu, recognised %zu, within %zu "
        "keyframes %zu; false loops accepted %zu\n",
        figures.revisits, figures.first_is_same, figures.recognised, kInTime, figures.found_in_time,
        figures.false_accepted);
  } else {
    std::printf("  no ground truth: whether they are right is unknown (--ground-truth, --same-after)\n");
  }
  if (figures.posed > 0) {
    std::printf("  poses: RMS %.4f m, %.3f deg; worst %.4f m, %.3f deg; NEES %.3g, 6 expected (%zu loops)\n",
                figures.rms_translation_m, figures.rms_rotation_deg, figures.worst_translation_m,
                figures.worst_rotation_deg, figures.nees_mean, figures.posed);
  }
  std::printf("  a keyframe: describing %.2f ms, recognition and verification %.2f ms, %.1f kB of index\n",
              meanOf(run.describe_ms), meanOf(run.loop_ms), 1e-3 * figures.index_bytes_per_keyframe);
}

}  // namespace stereo_nav::tools
