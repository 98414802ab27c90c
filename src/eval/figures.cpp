#include "eval/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/angles.h"
#include "eval/consistency.h"
#include "stereo_nav/eval/timing.h"

namespace stereo_nav::eval {
namespace {

using Row = std::vector<double>;
using RowOf = std::function<Row(const FrameErrors&)>;
constexpr double kNone = EvaluationSummary::kUnknown;  // gnuplot leaves a gap in the line

std::string toText(double value) {
  if (!std::isfinite(value)) return "NaN";
  return fmt::format("{:.7g}", value);
}

/// A gnuplot data block `$name`.
std::string dataBlock(const std::string& name, const std::vector<Row>& rows) {
  std::string text = "$" + name + " << EOD\n";
  for (const auto& row : rows) {
    for (const double value : row) text += toText(value) + " ";
    text += "\n";
  }
  return text + "EOD\n";
}

std::string dataBlock(const std::string& name, const std::vector<FrameErrors>& frames, const RowOf& row_of) {
  std::vector<Row> rows;
  for (const auto& frame : frames) rows.push_back(row_of(frame));
  return dataBlock(name, rows);
}

std::string header(const std::string& name, int height_px) {
  return "set terminal svg size 960," + std::to_string(height_px) + " dynamic font 'Helvetica,13' name '" +
         name +
         "' background rgb 'white'\n"
         "set border 3 lc rgb '#5f6b76'\nset tics nomirror out scale 0.6 textcolor rgb '#3a444d'\n"
         "set grid lc rgb '#dfe4e8' lw 1 dt 1\nset key outside top center horizontal samplen 2\n"
         "set style line 1 lc rgb '#1668b3' lw 2\nset style line 2 lc rgb '#9aa4ad' lw 4\n"
         "set style line 3 lc rgb '#c9302c' pt 7 ps 0.5\nset style line 4 lc rgb '#2b8a57' lw 2\n"
         "set style line 5 lc rgb '#b36b00' lw 2\n";
}

bool hasGroundTruth(const Evaluation& evaluation) {
  return evaluation.summary.frames_with_ground_truth > 0;
}

/// Positions in columns x y z, all of base_link in odom.
std::string pathData(const Evaluation& evaluation) {
  const auto position = [](const FrameErrors& frame) -> Row {
    return {frame.time_s, frame.position_m.x(), frame.position_m.y(), frame.position_m.z()};
  };
  const auto lost = [&position](const FrameErrors& frame) -> Row {
    return frame.lost ? position(frame) : Row{frame.time_s, kNone, kNone, kNone};
  };
  const auto truth = [](const FrameErrors& frame) -> Row {
    const Eigen::Vector3d p = frame.ground_truth_m.value_or(Eigen::Vector3d::Constant(kNone));
    return {frame.time_s, p.x(), p.y(), p.z()};
  };
  return dataBlock("estimate", evaluation.frames, position) + dataBlock("lost", evaluation.frames, lost) +
         dataBlock("truth", evaluation.frames, truth);
}

/// Estimate over ground truth, with lost frames marked; `columns` as gnuplot names them, e.g. "2:3".
std::string pathPlot(const Evaluation& evaluation, const std::string& columns) {
  std::string plot = "plot ";
  if (hasGroundTruth(evaluation)) {
    plot += "$truth using " + columns + " with lines ls 2 title 'ground truth', ";
  }
  plot += "$estimate using " + columns + " with lines ls 1 title 'estimate'";
  if (evaluation.summary.frames_lost > 0) {
    plot += ", $lost using " + columns + " with points ls 3 title 'lost (pose held)'";
  }
  return plot;
}

/// Ranges of x and y around the whole path that fill the picture at equal scales, however narrow the path is.
std::string equalRanges(const Evaluation& evaluation) {
  Eigen::AlignedBox2d box;
  for (const auto& frame : evaluation.frames) {
    box.extend(Eigen::Vector2d(frame.position_m.head<2>()));
    if (frame.ground_truth_m) box.extend(Eigen::Vector2d(frame.ground_truth_m->head<2>()));
  }
  constexpr double kWidthOverHeight = 2.0;
  constexpr double kMargin = 1.1;
  const Eigen::Vector2d half = 0.5 * kMargin * box.sizes().cwiseMax(0.1);
  const double half_x = std::max(half.x(), half.y() * kWidthOverHeight);
  const double half_y = half_x / kWidthOverHeight;
  const Eigen::Vector2d centre = box.center();
  return "set xrange [" + toText(centre.x() - half_x) + ":" + toText(centre.x() + half_x) +
         "]\nset yrange [" + toText(centre.y() - half_y) + ":" + toText(centre.y() + half_y) + "]\n";
}

std::string timeAxis(const Evaluation& evaluation) {
  return "set xlabel 'time [s]'\nset xrange [0:" + toText(std::max(evaluation.frames.back().time_s, 0.1)) +
         "]\n";
}

Figure topView(const Evaluation& evaluation) {
  const std::string start =
      ", $estimate every ::0::0 using 2:3 with points pt 6 ps 1.2 lw 2 lc rgb '#20262b' title 'start'\n";
  return {
      "path_top",
      "Path in the x-y plane of odom (from above, where z of base_link points up): base_link, ground truth "
      "laid onto the first pose. Equal scales.",
      header("path_top", 560) + pathData(evaluation) + equalRanges(evaluation) +
          "set size ratio -1\n"
          "set xlabel 'x [m]'\nset ylabel 'y [m]'\n" +
          pathPlot(evaluation, "2:3") + start};
}

Figure heightView(const Evaluation& evaluation) {
  return {"path_height", "Height over time: z of base_link in odom, ground truth laid onto the first pose.",
          header("path_height", 280) + pathData(evaluation) + timeAxis(evaluation) + "set ylabel 'z [m]'\n" +
              pathPlot(evaluation, "1:4") + "\n"};
}

double threeSigma(const Matrix6d& covariance, const std::vector<Eigen::Index>& axes) {
  double variance = 0.0;
  for (const Eigen::Index axis : axes) variance += covariance(axis, axis);
  return 3.0 * std::sqrt(variance);
}

Figure errorsOverTime(const Evaluation& evaluation) {
  const KnownAxes axes = knownAxes(evaluation.summary.planar);
  const auto errors = [&axes](const FrameErrors& frame) -> Row {
    Row row{frame.time_s, frame.absolute_error_m, frame.rotation_error_deg, kNone, kNone};
    if (!frame.pose_covariance) return row;
    row[3] = threeSigma(*frame.pose_covariance, axes.translation);
    row[4] = threeSigma(*frame.pose_covariance, axes.rotation) * kDegPerRad;
    return row;
  };
  return {
      "error",
      std::string("Error over time. Position: of ") +
          (evaluation.summary.planar ? "base_link" : "the left camera") +
          ", after SE(3) alignment without scale (what the absolute "
          "error sums up). Rotation: with the first poses aligned, so that drift grows from zero. "
          "Grey: three standard deviations of the published covariance, which both are to stay below nearly always.",
      header("error", 440) + dataBlock("errors", evaluation.frames, errors) + timeAxis(evaluation) +
          "unset xlabel\nset multiplot layout 2,1\nset yrange [0:*]\nset lmargin 10\nunset key\n"
          "set ylabel 'position [m]'\nplot $errors using 1:4 with lines ls 2, $errors using 1:2 with lines ls 1\n"
          "set xlabel 'time [s]'\nset ylabel 'rotation [deg]'\nplot $errors using 1:5 with lines ls 2, $errors using 1:3 with lines ls 5\n"
          "unset multiplot\n"};
}

Figure featuresOverTime(const Evaluation& evaluation) {
  const auto counts = [](const FrameErrors& frame) -> Row {
    return {frame.time_s, static_cast<double>(frame.features), static_cast<double>(frame.inliers),
            frame.lost ? 0.0 : kNone};
  };
  std::string plot =
      "plot $counts using 1:2 with lines ls 1 title 'features', $counts using 1:3 with lines ls 4 title "
      "'inliers'";
  if (evaluation.summary.frames_lost > 0) {
    plot += ", $counts using 1:4 with points ls 3 title 'frame lost'";
  }
  return {"features", "Features and inliers of each frame.",
          header("features", 300) + dataBlock("counts", evaluation.frames, counts) + timeAxis(evaluation) +
              "set yrange [0:*]\nset ylabel 'count'\n" + plot + "\n"};
}

std::string gnuplotEscaped(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return result;
}

double stageTime(const FrameTiming& timing, const std::string& stage) {
  double total_ms = 0.0;
  for (const auto& [name, ms] : timing.stages_ms) total_ms += name == stage ? ms : 0.0;
  return total_ms;
}

/// Times of the stages, stacked; the last one is drawn first so that the earlier ones lie on top of it.
Figure stagesOverTime(const Evaluation& evaluation, const std::vector<FrameRecord>& records) {
  std::vector<FrameTiming> timings;
  for (const auto& record : records) timings.push_back(record.timing);
  const auto stages = summariseTiming(timings).stage_medians_ms;
  std::vector<Row> rows;
  for (std::size_t i = 0; i < records.size(); ++i) {
    Row row{evaluation.frames[i].time_s, timings[i].frame_ms};
    double pile_ms = 0.0;
    for (const auto& [stage, median_ms] : stages) row.push_back(pile_ms += stageTime(timings[i], stage));
    rows.push_back(row);
  }
  const std::vector<std::string> colours = {"#1668b3", "#e0a03a", "#2b8a57", "#8a5fb0", "#c9524e",
                                            "#4fa6a6", "#8c6d46", "#d583b5", "#6f7b85", "#a8b33a"};
  std::string plot;
  for (std::size_t s = stages.size(); s-- > 0;) {
    const std::string median = fmt::format(" ({:.2f} ms)", stages[s].second);
    plot += "$times using 1:" + std::to_string(s + 3) + " with filledcurves y1=0 lc rgb '" +
            colours[s % colours.size()] + "' title '" + gnuplotEscaped(stages[s].first) + median + "', ";
  }
  return {"stages", "Time per stage, stacked, with medians in the legend; the line is the whole frame.",
          header("stages", 380) + dataBlock("times", rows) +
              "set key outside right center vertical noenhanced\nset yrange [0:*]\nset style fill solid\n" +
              timeAxis(evaluation) + "set ylabel 'time per frame [ms]'\nplot " + plot +
              "$times using 1:2 with lines lc rgb '#20262b' lw 1 title 'whole frame'\n"};
}

}  // namespace

std::vector<Figure> makeFigures(const Evaluation& evaluation, const std::vector<FrameRecord>& records) {
  const bool planar = evaluation.summary.planar;  // neither height nor images
  std::vector<Figure> figures = {topView(evaluation)};
  if (!planar) figures.push_back(heightView(evaluation));
  if (hasGroundTruth(evaluation)) figures.push_back(errorsOverTime(evaluation));
  if (!planar) figures.push_back(featuresOverTime(evaluation));
  figures.push_back(stagesOverTime(evaluation, records));
  return figures;
}

}  // namespace stereo_nav::eval
