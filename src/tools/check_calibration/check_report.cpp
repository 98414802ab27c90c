#include "tools/check_calibration/check_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/angles.h"

namespace stereo_nav::tools {
namespace {

using calibration::CalibrationCheck;
using calibration::Criterion;
using calibration::ViewFigures;

double degrees(double radians) {
  return radians * kDegPerRad;
}

/// A number of each view with its mean, standard deviation and range.
struct Statistics {
  double mean = 0.0, deviation = 0.0, least = 0.0, most = 0.0;

  template <class Number>
  Statistics(const std::vector<ViewFigures>& views, Number number) {
    std::vector<double> values;
    for (const ViewFigures& view : views) values.push_back(number(view));
    const auto n = static_cast<double>(values.size());
    for (const double value : values) mean += value / n;
    for (const double value : values) deviation += (value - mean) * (value - mean) / std::max(n - 1.0, 1.0);
    deviation = std::sqrt(deviation);
    least = *std::min_element(values.begin(), values.end());
    most = *std::max_element(values.begin(), values.end());
  }
};

struct NamedStatistics {
  const char* name;
  const char* unit;
  Statistics statistics;
};

std::vector<NamedStatistics> boardStatistics(const std::vector<ViewFigures>& views) {
  const auto position = [](int axis) {
    return [axis](const ViewFigures& view) { return view.pose.T_camera_board.translation()(axis); };
  };
  const auto angle = [](double calibration::BoardAngles::*which) {
    return [which](const ViewFigures& view) {
      return degrees(calibration::boardAngles(view.pose.T_camera_board.linear()).*which);
    };
  };
  return {{"distance", "m", {views, [](const ViewFigures& view) { return view.distance_m(); }}},
          {"x", "m", {views, position(0)}},
          {"y", "m", {views, position(1)}},
          {"z", "m", {views, position(2)}},
          {"yaw", "deg", {views, angle(&calibration::BoardAngles::yaw_rad)}},
          {"pitch", "deg", {views, angle(&calibration::BoardAngles::pitch_rad)}},
          {"roll", "deg", {views, angle(&calibration::BoardAngles::roll_rad)}}};
}

struct ViewSize {
  double horizontal_deg, vertical_deg;
};

ViewSize rectifiedView(const calibration::StereoRig& rig) {
  const vision::StereoCalibration& c = rig.rectified;
  return {degrees(calibration::rectifiedView_rad(c.fx, c.cx, c.width)),
          degrees(calibration::rectifiedView_rad(c.fy, c.cy, c.height))};
}

ViewSize rawView(const calibration::CameraModel& camera) {
  return {degrees(camera.horizontalView_rad()), degrees(camera.verticalView_rad())};
}

/// Notes that follow from how the views were taken, not from the views themselves.
std::vector<std::string> allNotes(const CheckedInput& input, const CalibrationCheck& check) {
  std::vector<std::string> notes = check.notes;
  constexpr double kSimultaneous_s = 0.002;
  if (input.largest_time_offset_s > kSimultaneous_s) {
    notes.push_back(
        fmt::format("the images of a pair are up to {:.0f} ms apart: only a board at rest gives true figures",
                    1000.0 * input.largest_time_offset_s));
  }
  return notes;
}

struct NamedSigma {
  const char* parameter;  ///< of estimation::UncertaintyParams
  const char* meaning;
  const std::optional<double>& value;
};

std::vector<NamedSigma> named(const calibration::CalibrationUncertainty& uncertainty) {
  return {{"baseline_sigma_share", "of the distance between the cameras", uncertainty.baseline_share},
          {"focal_sigma_share", "of the focal length", uncertainty.focal_share},
          {"column_offset_sigma_px", "px of the right camera's columns", uncertainty.column_offset_px},
          {"distortion_sigma_px", "px that the lens models leave over", uncertainty.distortion_px}};
}

std::string uncertaintyText(const calibration::CalibrationUncertainty& uncertainty) {
  std::string text =
      "\nstandard deviations of the calibration, `uncertainty` of the rig file (--rig writes them)\n";
  for (const NamedSigma& one : named(uncertainty)) {
    text +=
        one.value
            ? fmt::format("  {:<23} {:8.5f}  {}\n", one.parameter + std::string(":"), *one.value, one.meaning)
            : fmt::format(
                  "  {:<23} {:>8}  {}: the views do not tell; show the board near and far, tilted, all over "
                  "the image\n",
                  one.parameter + std::string(":"), "-", one.meaning);
  }
  return text;
}

std::string verdictText(const CalibrationCheck& check) {
  if (check.good()) return "good: every figure is within its limit\n";
  std::string text = "poor:\n";
  for (const Criterion& one : check.criteria) {
    if (!one.met()) text += "  " + one.name + ": " + one.remedy + "\n";
  }
  return text;
}

nlohmann::json viewJson(const ViewFigures& view) {
  const Eigen::Vector3d p = view.pose.T_camera_board.translation();
  const auto angles = calibration::boardAngles(view.pose.T_camera_board.linear());
  const Vector6d sigma = view.pose.covariance.diagonal().cwiseSqrt();
  return {{"name", view.name},
          {"position_m", {p.x(), p.y(), p.z()}},
          {"distance_m", view.distance_m()},
          {"yaw_deg", degrees(angles.yaw_rad)},
          {"pitch_deg", degrees(angles.pitch_rad)},
          {"roll_deg", degrees(angles.roll_rad)},
          {"rotation_sigma_deg", {degrees(sigma(3)), degrees(sigma(4)), degrees(sigma(5))}},
          {"left_lens_px", view.left_lens_px},
          {"right_lens_px", view.right_lens_px},
          {"epipolar_rms_px", view.epipolar_rms_px},
          {"disparity_rms_px", view.disparity_rms_px},
          {"scale", view.scale}};
}

}  // namespace

std::string viewHeading() {
  return "view              x       y       z   distance     yaw   pitch    roll   reproj.  epipolar\n"
         "                  m       m       m          m     deg     deg     deg        px        px\n";
}

std::string viewLine(const ViewFigures& view) {
  const Eigen::Vector3d p = view.pose.T_camera_board.translation();
  const auto angles = calibration::boardAngles(view.pose.T_camera_board.linear());
  double squares = 0.0;
  for (const Eigen::Vector4d& residual : view.pose.residual_px) squares += residual.squaredNorm() / 2.0;
  return fmt::format("{:<14}{:7.3f} {:7.3f} {:7.3f} {:10.4f} {:7.2f} {:7.2f} {:7.2f} {:9.3f} {:9.3f}\n",
                     view.name, p.x(), p.y(), p.z(), view.distance_m(), degrees(angles.yaw_rad),
                     degrees(angles.pitch_rad), degrees(angles.roll_rad),
                     std::sqrt(squares / static_cast<double>(view.pose.residual_px.size())),
                     view.epipolar_rms_px);
}

void setUncertainty(const calibration::CalibrationUncertainty& uncertainty, RigFile& rig) {
  for (const NamedSigma& one : named(uncertainty)) {
    if (one.value)
      rig.setNumber({rig_sections::kUncertainty, one.parameter}, fmt::format("{:.5f}", *one.value));
  }
}

std::string reportText(const CheckedInput& input, const CalibrationCheck& check,
                       const calibration::CalibrationUncertainty& uncertainty) {
  const calibration::StereoRig& rig = input.rig;
  const ViewSize left = rawView(rig.left), right = rawView(rig.right), rectified = rectifiedView(rig);
  std::string text = "\n" + input.calibration + ", " + std::to_string(rig.rectified.width) + "x" +
                     std::to_string(rig.rectified.height) + "; board of " +
                     std::to_string(input.board.columns) + "x" + std::to_string(input.board.rows) +
                     fmt::format(" corners, {:.1f} mm: ", 1000.0 * input.board.square_m) +
                     std::to_string(check.views.size()) + " of " + std::to_string(input.pairs) + " pairs\n";
  text += fmt::format("baseline {:.2f} mm, focal length {:.2f} px\n", 1000.0 * rig.rectified.baseline_m,
                      rig.rectified.fx);
  text += fmt::format(
      "field of view: left {:.1f} x {:.1f} deg, right {:.1f} x {:.1f} deg, rectified {:.1f} x {:.1f} deg\n\n",
      left.horizontal_deg, left.vertical_deg, right.horizontal_deg, right.vertical_deg,
      rectified.horizontal_deg, rectified.vertical_deg);
  text += "board, over the views    mean  deviation      least       most\n";
  for (const NamedStatistics& one : boardStatistics(check.views)) {
    text +=
        fmt::format("  {:<8} {:<4} {:13.4f} {:10.4f} {:10.4f} {:10.4f}\n", one.name, one.unit,
                    one.statistics.mean, one.statistics.deviation, one.statistics.least, one.statistics.most);
  }
  text += fmt::format("\ndepth to expect with the disparity noise of {:.3f} px\n  distance, m    ",
                      check.disparity_rms_px);
  for (int depth = 1; depth <= 10; ++depth) text += fmt::format("{:7}", depth);
  text += "\n  deviation, mm  ";
  for (int depth = 1; depth <= 10; ++depth)
    text += fmt::format("{:7.1f}", 1000.0 * check.depthNoise_m(rig.rectified, depth));
  text += "\n\nerror, RMS          found     limit\n";
  for (const Criterion& one : check.criteria) {
    text += fmt::format("  {:<14} {:8.3f} {:9.2f} {:<2}  {}\n", one.name, one.value, one.limit, one.unit,
                        one.met() ? "good" : "poor");
  }
  text += uncertaintyText(uncertainty);
  text += "\n" + verdictText(check);
  for (const std::string& note : allNotes(input, check)) text += "note: " + note + "\n";
  return text;
}

std::string reportJson(const CheckedInput& input, const CalibrationCheck& check,
                       const calibration::CalibrationUncertainty& uncertainty) {
  using nlohmann::json;
  const calibration::StereoRig& rig = input.rig;
  const auto size = [](const ViewSize& view) {
    return json::array({view.horizontal_deg, view.vertical_deg});
  };
  json report = {
      {"verdict", check.good() ? "good" : "poor"},
      {"input", input.input},
      {"calibration", input.calibration},
      {"pairs", input.pairs},
      {"image_size", {rig.rectified.width, rig.rectified.height}},
      {"board",
       {{"columns", input.board.columns}, {"rows", input.board.rows}, {"square_m", input.board.square_m}}},
      {"baseline_m", rig.rectified.baseline_m},
      {"focal_length_px", rig.rectified.fx},
      {"field_of_view_deg",
       {{"left", size(rawView(rig.left))},
        {"right", size(rawView(rig.right))},
        {"rectified", size(rectifiedView(rig))}}},
      {"disparity_noise_px", check.disparity_rms_px},
      {"epipolar_mean_px", check.epipolar_mean_px},
      {"notes", allNotes(input, check)}};
  for (const Criterion& one : check.criteria) {
    report["criteria"].push_back({{"name", one.name},
                                  {"value", one.value},
                                  {"limit", one.limit},
                                  {"unit", one.unit},
                                  {"met", one.met()},
                                  {"remedy", one.met() ? "" : one.remedy}});
  }
  for (const NamedSigma& one : named(uncertainty))
    report["uncertainty"][one.parameter] = one.value ? json(*one.value) : json();
  for (int depth = 1; depth <= 10; ++depth) {
    report["depth_deviation_m"].push_back(
        {{"depth_m", depth}, {"deviation_m", check.depthNoise_m(rig.rectified, depth)}});
  }
  for (const NamedStatistics& one : boardStatistics(check.views)) {
    report["board_statistics"][std::string(one.name) + "_" + one.unit] = {
        {"mean", one.statistics.mean},
        {"deviation", one.statistics.deviation},
        {"least", one.statistics.least},
        {"most", one.statistics.most}};
  }
  for (const ViewFigures& view : check.views) report["views"].push_back(viewJson(view));
  return report.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace stereo_nav::tools
