#include "tools/closed_loop/closed_loop_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/gnuplot.h"
#include "eval/json_text.h"

namespace stereo_nav::tools {
namespace {

std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  return '"' + text + '"';
}

double totalDuration_s(const LoopResults& results) {
  double total_s = 0.0;
  for (const GoalResult& goal : results.goals) total_s += goal.duration_s;
  return total_s;
}

/// The outlines of what stands there: cells that are occupied beside one that is free.
std::string outlines(const grid::OccupancyGrid& walls) {
  std::string text;
  const auto isFree = [&walls](int x, int y) {
    return walls.geometry.contains({x, y}) && walls.at({x, y}) == grid::kFree;
  };
  for (int y = 0; y < walls.geometry.height; ++y) {
    for (int x = 0; x < walls.geometry.width; ++x) {
      if (isFree(x, y) || !(isFree(x - 1, y) || isFree(x + 1, y) || isFree(x, y - 1) || isFree(x, y + 1)))
        continue;
      const Eigen::Vector2d p = walls.geometry.centreOf({x, y});
      text += fmt::format("{:.3f} {:.3f}\n", p.x(), p.y());
    }
  }
  return text;
}

}  // namespace

std::size_t LoopResults::reached() const {
  return static_cast<std::size_t>(
      std::count_if(goals.begin(), goals.end(), [](const GoalResult& goal) { return goal.isThere(); }));
}

std::size_t LoopResults::wrong() const {
  return static_cast<std::size_t>(std::count_if(
      goals.begin(), goals.end(), [](const GoalResult& goal) { return goal.arrived && !goal.isThere(); }));
}

std::string toCsv(const LoopResults& results) {
  std::string text = "x_m,y_m,arrived,there,duration_s,way_m,distance_m,collisions,words\n";
  for (const GoalResult& goal : results.goals) {
    text += fmt::format("{:.3f},{:.3f},{:d},{:d},{:.2f},{:.3f},{:.4f},{},{}\n", goal.goal_world.x(),
                        goal.goal_world.y(), goal.arrived, goal.isThere(), goal.duration_s, goal.way_m,
                        goal.distance_m, goal.collisions, quoted(goal.words));
  }
  return text;
}

std::string toCsv(const std::vector<TracePoint>& trace) {
  std::string text = "time_s,true_x_m,true_y_m,x_m,y_m,forward_m_per_s,left_m_per_s,turn_rad_per_s,words\n";
  for (const TracePoint& point : trace) {
    text += fmt::format("{:.3f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{}\n", point.time_s,
                        point.truth.x(), point.truth.y(), point.estimate.x(), point.estimate.y(),
                        point.command.x(), point.command.y(), point.command.z(), quoted(point.words));
  }
  return text;
}

std::string toJson(const LoopResults& results) {
  eval::JsonObject json;
  json.add("goals", results.goals.size());
  json.add("reached", results.reached());
  json.add("wrong", results.wrong());
  json.add("named_failures", results.goals.size() - results.reached() - results.wrong());
  json.add("collisions", results.collisions);
  json.add("duration_s", totalDuration_s(results));
  json.add("way_m", results.goals.empty() ? 0.0 : results.goals.back().way_m);
  json.add("frames", results.frames);
  json.add("frames_lost", results.frames_lost);
  return json.text() + "\n";
}

std::string table(const LoopResults& results) {
  std::string text = "| goal x, y m | time s | way so far m | off mm | |\n|---|---|---|---|---|\n";
  for (const GoalResult& goal : results.goals) {
    text += fmt::format("| {:.2f}, {:.2f} | {:.1f} | {:.2f} | {:.0f} | {}{} |\n", goal.goal_world.x(),
                        goal.goal_world.y(), goal.duration_s, goal.way_m, 1e3 * goal.distance_m,
                        goal.arrived ? "" : goal.words,
                        goal.collisions > 0 ? fmt::format(" {} collisions", goal.collisions) : "");
  }
  return text +
         fmt::format(
             "{} of {} goals reached, {} missed unnoticed, {} collisions, {:.0f} s; {} of {} frames without a "
             "measured motion\n",
             results.reached(), results.goals.size(), results.wrong(), results.collisions,
             totalDuration_s(results), results.frames_lost, results.frames);
}

std::string drawWay(const LoopResults& results, const std::vector<TracePoint>& trace,
                    const grid::OccupancyGrid& walls, const std::string& title,
                    const std::string& path_prefix) {
  std::string truth, estimate, goals;
  for (const TracePoint& point : trace) {
    truth += fmt::format("{:.3f} {:.3f}\n", point.truth.x(), point.truth.y());
    estimate += fmt::format("{:.3f} {:.3f}\n", point.estimate.x(), point.estimate.y());
  }
  for (const GoalResult& goal : results.goals)
    goals += fmt::format("{:.3f} {:.3f}\n", goal.goal_world.x(), goal.goal_world.y());
  const std::string script =
      fmt::format("$walls << E\n{}E\n$truth << E\n{}E\n$estimate << E\n{}E\n$goals << E\n{}E\n",
                  outlines(walls), truth, estimate, goals) +
      "set terminal svg size 900,700 dynamic noenhanced font 'Helvetica,13' background rgb 'white'\n"
      "set border 3 lc rgb '#5f6b76'\nset tics nomirror out scale 0.6 textcolor rgb '#3a444d'\n"
      "set grid lc rgb '#dfe4e8' lw 1 dt 1\nset key outside top center horizontal samplen 2\n"
      "set size ratio -1\nset xlabel 'x, m'\nset ylabel 'y, m'\n" +
      fmt::format("set title '{}'\n", title) +
      "plot $walls with dots lc rgb '#5f6b76' notitle, $truth with lines lc rgb '#9aa4ad' lw 4 title 'truth', "
      "$estimate with lines lc rgb '#1668b3' lw 1.5 title 'as the robot took it', "
      "$goals with points pt 6 ps 1.2 lw 2 lc rgb '#c9302c' title 'goals'\n";
  return eval::runGnuplot(script, path_prefix);
}

}  // namespace stereo_nav::tools
