#include "tools/build_map/map_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base_pose.h"
#include "eval/alignment.h"
#include "eval/json_text.h"

namespace stereo_nav::tools {
namespace {

std::string row(const Eigen::Isometry3d& T) {
  return fmt::format("{:.6g} {:.6g}\n", T.translation().x(), T.translation().y());
}

std::string way(const std::string& name, const eval::EvaluationInput& input) {
  std::string text = "$" + name + " << EOD\nNaN NaN\n";
  for (const auto& frame : input.frames)
    if (frame.T_odom_base) text += row(*frame.T_odom_base);
  return text + "EOD\n";
}

/// Laid onto the first pose.
std::string truth(const eval::EvaluationInput& input) {
  std::string text = "$truth << EOD\nNaN NaN\n";
  std::optional<Eigen::Isometry3d> T_odom_world;
  for (const auto& frame : input.frames) {
    const auto T_world_base = eval::poseAt(input.ground_truth, frame.time_s);
    if (!T_world_base || !frame.T_odom_base) continue;
    if (!T_odom_world) T_odom_world = *frame.T_odom_base * T_world_base->inverse();
    text += row(*T_odom_world * *T_world_base);
  }
  return text + "EOD\n";
}

std::string loops(const MapRun& run, const std::string& name, bool kept) {
  std::string text = "$" + name + " << EOD\nNaN NaN\n";
  const Eigen::Isometry3d& T_base_camera = run.after.T_base_camera;
  for (const mapping::MapLoop& loop : run.map.loops) {
    if (loop.kept != kept) continue;
    text += "\n";
    for (const std::uint32_t id : {loop.from_id, loop.to_id}) {
      const std::size_t index = mapping::indexOfKeyframe(run.map, id).value();
      text += row(basePose(T_base_camera, run.map.keyframes[index].T_map_camera));
    }
  }
  return text + "EOD\n";
}

eval::JsonObject errors(const eval::EvaluationSummary& summary) {
  eval::JsonObject json;
  json.add("ate_rmse_m", summary.ate_rmse_m);
  json.add("rpe_translation_percent", summary.rpe_translation_percent);
  json.add("rpe_rotation_deg_per_m", summary.rpe_rotation_deg_per_m);
  json.add("end_error_percent", summary.end_error_percent);
  return json;
}

}  // namespace

MapFigures figuresOf(const MapRun& run) {
  MapFigures figures;
  figures.before = eval::evaluate(run.before).summary;
  figures.after = eval::evaluate(run.after).summary;
  figures.candidates = run.candidates.size();
  figures.accepted = run.map.loops.size();
  figures.kept = static_cast<std::size_t>(std::count_if(
      run.map.loops.begin(), run.map.loops.end(), [](const mapping::MapLoop& loop) { return loop.kept; }));
  return figures;
}

std::string summaryJson(const MapRun& run, const MapFigures& figures) {
  eval::JsonObject json;
  json.add("input", run.before.input);
  json.add("config", run.before.config);
  json.add("frames", figures.before.frames);
  json.add("frames_lost", figures.before.frames_lost);
  json.add("path_length_m", figures.before.path_length_m);
  json.add("keyframes", run.map.keyframes.size());
  json.add("landmarks", run.map.landmarks.size());
  json.add("candidates", figures.candidates);
  json.add("loops_accepted", figures.accepted);
  json.add("loops_kept", figures.kept);
  json.add("before", errors(figures.before));
  json.add("after", errors(figures.after));
  return json.text() + "\n";
}

std::string timingJson(const MapRun& run) {
  eval::JsonObject json;
  json.add("keyframe_ms", run.keyframe_ms);
  json.add("closing_ms", run.closing_ms);
  return json.text() + "\n";
}

std::string loopsCsv(const MapRun& run) {
  std::string text = "from,to,kept,chi_square,agrees,reason\n";
  for (std::size_t i = 0; i < run.map.loops.size(); ++i) {
    const mapping::MapLoop& loop = run.map.loops[i];
    const mapping::LoopVerdict& verdict = run.verdicts[i];
    text += fmt::format("{},{},{},{:.6g},{},\"{}\"\n", loop.from_id, loop.to_id, loop.kept ? 1 : 0,
                        verdict.chi_square, verdict.agrees, verdict.reason);
  }
  return text;
}

std::string pictureScript(const MapRun& run) {
  return "set terminal svg size 900,800 dynamic font 'Helvetica,13' name 'map' background rgb 'white'\n"
         "set border 3 lc rgb '#5f6b76'\nset tics nomirror out scale 0.6 textcolor rgb '#3a444d'\n"
         "set grid lc rgb '#dfe4e8' lw 1 dt 1\nset key outside top center horizontal samplen 2\n"
         "set size ratio -1\nset xlabel 'x [m]'\nset ylabel 'y [m]'\n" +
         truth(run.after) + way("before", run.before) + way("after", run.after) + loops(run, "kept", true) +
         loops(run, "rejected", false) +
         "plot $truth using 1:2 with lines lw 5 lc rgb '#dfe4e8' title 'truth', "
         "$before using 1:2 with lines lw 1 lc rgb '#9aa4ad' title 'odometry', "
         "$after using 1:2 with lines lw 1.5 lc rgb '#1668b3' title 'closed', "
         "$kept using 1:2 with lines lw 2 lc rgb '#2b8a57' title 'loop kept', "
         "$rejected using 1:2 with lines lw 1 lc rgb '#c9302c' title 'loop rejected'\n";
}

void print(const MapRun& run, const MapFigures& figures) {
  std::printf("%s: %zu frames, %zu keyframes, %zu landmarks\n", run.before.input.c_str(),
              figures.before.frames, run.map.keyframes.size(), run.map.landmarks.size());
  std::printf("  loops: %zu candidates, %zu accepted, %zu kept\n", figures.candidates, figures.accepted,
              figures.kept);
  if (std::isfinite(figures.after.ate_rmse_m))
    std::printf("  ATE (RMSE, SE(3) aligned)  %.4g m by the odometry, %.4g m with its loops closed\n",
                figures.before.ate_rmse_m, figures.after.ate_rmse_m);
  std::printf("  processor time             %.1f ms a keyframe, %.0f ms for closing\n", run.keyframe_ms,
              run.closing_ms);
}

}  // namespace stereo_nav::tools
