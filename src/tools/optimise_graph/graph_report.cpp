#include "tools/optimise_graph/graph_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "eval/json_text.h"

namespace stereo_nav::tools {
namespace {

/// How many loops with `kept` as asked are false, or true: false ones are the last edges.
std::size_t count(const GraphRun& run, bool kept, bool is_false) {
  const std::size_t first_false = run.edges - run.false_loops;
  return static_cast<std::size_t>(std::count_if(
      run.judgement.loops.begin(), run.judgement.loops.end(),
      [&](const auto& loop) { return loop.kept == kept && (loop.edge >= first_false) == is_false; }));
}

std::string path(const std::string& name, const std::vector<Eigen::Vector3d>& positions_m) {
  std::string text = "$" + name + " << EOD\n";
  for (const auto& p : positions_m) text += fmt::format("{:.7g} {:.7g}\n", p.x(), p.y());
  return text + "EOD\n";
}

std::string lines(const GraphRun& run, const std::string& name, bool kept) {
  std::string text = "$" + name + " << EOD\nNaN NaN\n";
  for (const auto& loop : run.judgement.loops) {
    if (loop.kept != kept) continue;
    const auto& [from, to] = run.ends[loop.edge];
    text += fmt::format("\n{:.7g} {:.7g}\n{:.7g} {:.7g}\n", run.after_m[from].x(), run.after_m[from].y(),
                        run.after_m[to].x(), run.after_m[to].y());
  }
  return text + "EOD\n";
}

}  // namespace

std::string toJson(const GraphRun& run) {
  eval::JsonObject json;
  json.add("file", run.file);
  json.add("vertices", run.vertices);
  json.add("edges", run.edges);
  json.add("loops", run.loops);
  json.add("chi_square_before", run.optimiser.chi_square_before);
  json.add("chi_square_after", run.optimiser.chi_square_after);
  if (!run.robust) {
    json.add("iterations", run.optimiser.iterations);
    json.add("chordal_start", run.optimiser.chordal);
  }
  json.add("converged", run.optimiser.converged);
  json.add("processor_time_ms", run.processor_time_ms);
  if (run.robust) {
    json.add("loops_kept", count(run, true, false) + count(run, true, true));
    json.add("loops_consistent", run.judgement.consistent);
    json.add("consistent_set_is_largest", run.judgement.largest);
  }
  if (run.false_loops > 0) {
    json.add("false_loops_added", run.false_loops);
    json.add("false_loops_kept", run.robust ? count(run, true, true) : run.false_loops);
    if (run.robust) json.add("true_loops_rejected", count(run, false, false));
    if (run.rms_from_clean_m) json.add("rms_from_clean_optimum_m", *run.rms_from_clean_m);
  }
  return json.text() + "\n";
}

std::string loopsCsv(const GraphRun& run) {
  std::string text = "from,to,kept,chi_square,agrees,reason\n";
  for (const auto& loop : run.judgement.loops) {
    const auto& [from, to] = run.ends[loop.edge];
    text += fmt::format("{},{},{},{:.6g},{},\"{}\"\n", run.ids[from], run.ids[to], loop.kept ? 1 : 0,
                        loop.chi_square, loop.agrees, loop.reason);
  }
  return text;
}

std::string pictureScript(const GraphRun& run) {
  return "set terminal svg size 900,800 dynamic font 'Helvetica,13' name 'graph' background rgb 'white'\n"
         "set border 3 lc rgb '#5f6b76'\nset tics nomirror out scale 0.6 textcolor rgb '#3a444d'\n"
         "set grid lc rgb '#dfe4e8' lw 1 dt 1\nset key outside top center horizontal samplen 2\n"
         "set size ratio -1\nset xlabel 'x [m]'\nset ylabel 'y [m]'\n" +
         path("before", run.before_m) + path("after", run.after_m) + lines(run, "kept", true) +
         lines(run, "rejected", false) +
         "plot $before using 1:2 with lines lw 1 lc rgb '#9aa4ad' title 'before', "
         "$rejected using 1:2 with lines lw 1 lc rgb '#c9302c' title 'loop rejected', "
         "$after using 1:2 with lines lw 2 lc rgb '#1668b3' title 'after', "
         "$kept using 1:2 with lines lw 2 lc rgb '#2b8a57' title 'loop kept'\n";
}

void print(const GraphRun& run) {
  std::printf("%s: %zu vertices, %zu edges, of which %zu are loops\n", run.file.c_str(), run.vertices,
              run.edges, run.loops);
  if (run.robust) {
    std::printf("  chi-square %.6g before with all loops, %.6g after with those kept\n",
                run.optimiser.chi_square_before, run.optimiser.chi_square_after);
  } else {
    std::printf("  chi-square %.6g before, %.6g after %d iterations%s%s\n", run.optimiser.chi_square_before,
                run.optimiser.chi_square_after, run.optimiser.iterations,
                run.optimiser.chordal ? " from a chordal start" : "",
                run.optimiser.converged ? "" : ", not converged");
  }
  std::printf("  processor time %.1f ms\n", run.processor_time_ms);
  if (run.robust)
    std::printf("  loops kept %zu, rejected %zu; largest consistent set %zu%s\n",
                count(run, true, false) + count(run, true, true),
                count(run, false, false) + count(run, false, true), run.judgement.consistent,
                run.judgement.largest ? "" : " (the search ended at its budget)");
  if (run.false_loops > 0 && run.robust)
    std::printf("  of %zu false loops added %zu kept; of %zu true ones %zu rejected\n", run.false_loops,
                count(run, true, true), run.loops - run.false_loops, count(run, false, false));
  if (run.rms_from_clean_m)
    std::printf("  %.4f m RMS from the optimum without false loops\n", *run.rms_from_clean_m);
}

}  // namespace stereo_nav::tools
