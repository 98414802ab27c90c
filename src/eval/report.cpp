#include "stereo_nav/eval/report.h"

#include <fmt/format.h>

#include <cmath>

#include "core/atomic_file.h"
#include "eval/figures.h"
#include "eval/gnuplot.h"
#include "eval/losses.h"

namespace stereo_nav::eval {
namespace {

constexpr const char* kStyle = R"(
body{font:15px/1.5 system-ui,"Helvetica Neue",Arial,sans-serif;color:#20262b;background:#f4f6f8;margin:0}
main{max-width:1000px;margin:0 auto;padding:24px 20px 48px}
h1{font-size:22px;margin:0 0 4px}h2{font-size:17px;margin:32px 0 10px}
code{font:13px ui-monospace,"DejaVu Sans Mono",monospace}
.what{color:#56626c;margin:0 0 20px;overflow-wrap:anywhere}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(170px,1fr));gap:10px}
.tile{background:#fff;border:1px solid #dfe4e8;border-radius:6px;padding:10px 14px}
.tile b{display:block;font-size:23px;font-weight:600;font-variant-numeric:tabular-nums}
.tile span{color:#56626c;font-size:13px}
.bad b{color:#c9302c}
.warning{background:#fdf3df;border:1px solid #e6c884;border-radius:6px;padding:10px 14px;margin:20px 0}
figure{background:#fff;border:1px solid #dfe4e8;border-radius:6px;margin:14px 0;padding:10px 14px}
figure svg{width:100%;height:auto;display:block}
figcaption{color:#56626c;font-size:13px;padding-top:6px}
table{border-collapse:collapse;background:#fff;border:1px solid #dfe4e8}
td,th{padding:4px 14px;border-bottom:1px solid #e8ecef;text-align:left;vertical-align:top}
td.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
)";

std::string htmlEscaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '<') {
      result += "&lt;";
    } else if (c == '&') {
      result += "&amp;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string number(double value, int digits, const std::string& unit) {
  if (!std::isfinite(value)) return "\u2013";
  return fmt::format("{:.{}f}", value, digits) + (unit.empty() ? "" : "\u202f" + unit);
}

std::string tile(const std::string& label, const std::string& value, bool bad = false) {
  return std::string("<div class=\"tile") + (bad ? " bad" : "") + "\"><b>" + value + "</b><span>" + label +
         "</span></div>\n";
}

std::string tiles(const EvaluationSummary& summary, const TimingSummary& timing) {
  const bool has_truth = summary.frames_with_ground_truth > 0;
  return "<div class=\"tiles\">\n" +
         tile("relative translation error", number(summary.rpe_translation_percent, 2, "%")) +
         tile("relative rotation error", number(summary.rpe_rotation_deg_per_m, 3, "\u00b0/m")) +
         tile("absolute error (ATE RMSE)", number(summary.ate_rmse_m, 4, "m")) +
         tile("error at the end", number(summary.end_error_percent, 2, "%")) +
         tile(has_truth ? "path (ground truth)" : "path (estimate)", number(summary.path_length_m, 2, "m")) +
         tile("frames lost", std::to_string(summary.frames_lost) + " / " + std::to_string(summary.frames),
              summary.frames_lost > 0) +
         (summary.planar ? ""
                         : tile("inliers / features, mean", number(summary.inliers_mean, 0, "") + " / " +
                                                                number(summary.features_mean, 0, ""))) +
         tile("time per frame, median", number(timing.median_ms, summary.planar ? 4 : 1, "ms")) + "</div>\n";
}

std::string row(const std::string& name, const std::string& value, const std::string& meaning = "") {
  return "<tr><td>" + name + "</td><td class=\"n\">" + value + "</td><td>" + meaning + "</td></tr>\n";
}

std::string lengthsText(const std::vector<double>& lengths_m) {
  std::string text;
  for (const double length_m : lengths_m) {
    text += (text.empty() ? "" : ", ") + number(length_m, length_m < 1.0 ? 1 : 0, "m");
  }
  return text.empty() ? "none fits between 1/12 and 1/2 of the path" : text;
}

std::string accuracyTable(const EvaluationSummary& s) {
  return "<h2>Accuracy</h2>\n<table>\n" +
         row("relative translation", number(s.rpe_translation_percent, 3, "%"),
             "mean over all frames and the lengths " + lengthsText(s.segment_lengths_m)) +
         row("relative rotation", number(s.rpe_rotation_deg_per_m, 4, "\u00b0/m"),
             "mean over the same pieces") +
         row("absolute (ATE)", number(s.ate_rmse_m, 4, "m"),
             std::string("RMSE of the positions of ") + (s.planar ? "base_link" : "the left camera") +
                 " after SE(3) alignment without scale") +
         row("at the end", number(s.end_error_percent, 3, "%"),
             "of the path length, with the first poses aligned") +
         row("RMSE along x, y", number(s.rmse_x_m, 3, "m") + ", " + number(s.rmse_y_m, 3, "m"),
             "base_link along the axes of odom, with the first poses aligned") +
         row("MAE along x, y", number(s.mae_x_m, 3, "m") + ", " + number(s.mae_y_m, 3, "m"),
             "of the same errors") +
         row("frames with ground truth",
             std::to_string(s.frames_with_ground_truth) + " / " + std::to_string(s.frames),
             "frames used for the errors; a lost frame keeps its pose and is included") +
         "</table>\n";
}

/// Nothing without ground truth.
std::string consistencyTable(const EvaluationSummary& s) {
  std::string rows;
  for (std::size_t k = 0; k < kNeesIntervals_s.size(); ++k) {
    const Nees& nees = s.nees[k];
    if (nees.pairs == 0) continue;
    rows += row(
        fmt::format("NEES over {:g} s", kNeesIntervals_s[k]), number(nees.mean, 2, ""),
        fmt::format(
            "{} is expected; translation {:.2f} ({}), rotation {:.2f} ({}); {:.0f} % of {} pieces inside the "
            "ellipsoid of 95 %",
            nees.expected, nees.translation, nees.expected_translation, nees.rotation, nees.expected_rotation,
            nees.inside_95_percent, nees.pairs));
  }
  return rows.empty() ? "" : "<h2>Consistency of the covariances</h2>\n<table>\n" + rows + "</table>\n";
}

std::string timingTable(const TimingSummary& timing) {
  std::string text = "<h2>Time</h2>\n<table>\n" +
                     row("frame, median", number(timing.median_ms, 2, "ms"),
                         "the odometry alone: no decoding, rectification or disparity map") +
                     row("frame, 95 %", number(timing.p95_ms, 2, "ms")) +
                     row("frame, 99 %", number(timing.p99_ms, 2, "ms")) +
                     row("frame, longest", number(timing.max_ms, 2, "ms"));
  for (const auto& [stage, ms] : timing.stage_medians_ms) {
    text += row("stage: " + htmlEscaped(stage), number(ms, 2, "ms"),
                stage == "start" ? "once, at the start of a map" : "median");
  }
  if (std::isfinite(timing.disparity_median_ms))
    text += row("disparity map", number(timing.disparity_median_ms, 2, "ms"), "median, beside the frame");
  return text + "</table>\n";
}

std::string lossTable(const std::vector<Loss>& losses) {
  if (losses.empty()) return "";
  std::string text = "<h2>Lost frames</h2>\n<table>\n";
  for (const Loss& loss : losses) {
    text += "<tr><td>" + framesText(loss) + "</td><td>" + htmlEscaped(loss.reason) + "</td></tr>\n";
  }
  return text + "</table>\n";
}

/// The drawing alone, without the XML prologue of a separate file.
std::string inlineSvg(const std::string& svg) {
  return svg.substr(std::min(svg.find("<svg"), svg.size()));
}

}  // namespace

std::optional<std::string> writeReport(const std::string& directory, const Evaluation& evaluation,
                                       const EvaluationInput& input, const TimingSummary& timing) {
  std::optional<std::string> warning;
  std::string pictures;
  for (const auto& figure : makeFigures(evaluation, input.frames)) {
    const std::string path = directory + "/" + figure.name;
    try {
      const std::string svg = runGnuplot(figure.script, path);
      writeFileAtomically(path + ".svg", svg);
      pictures +=
          "<figure>\n" + inlineSvg(svg) + "<figcaption>" + figure.caption + "</figcaption></figure>\n";
    } catch (const GnuplotError& error) {
      warning = error.what();
    }
  }
  const EvaluationSummary& summary = evaluation.summary;
  std::string note = warning ? "<p class=\"warning\">" + htmlEscaped(*warning) + "</p>\n" : "";
  if (input.ground_truth.empty()) {
    note += "<p class=\"warning\">No ground truth: the errors are unknown, the path is the estimate's.</p>\n";
  }
  for (const std::string& line : input.notes) {
    note += "<p class=\"warning\">" + htmlEscaped(line) + "</p>\n";
  }
  writeFileAtomically(directory + "/report.html",
                      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>Odometry: " +
                          htmlEscaped(summary.input) + "</title>\n<style>" + kStyle +
                          "</style>\n</head>\n<body>\n<main>\n<h1>Odometry, evaluated</h1>\n"
                          "<p class=\"what\"><code>" +
                          htmlEscaped(summary.input) + "</code> with <code>" + htmlEscaped(summary.config) +
                          "</code></p>\n" + tiles(summary, timing) + note + "<h2>Pictures</h2>\n" + pictures +
                          accuracyTable(summary) + consistencyTable(summary) +
                          lossTable(lossesOf(evaluation.frames)) + timingTable(timing) +
                          "</main>\n</body>\n</html>\n");
  return warning;
}

}  // namespace stereo_nav::eval
