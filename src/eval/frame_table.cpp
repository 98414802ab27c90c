#include <fmt/format.h>

#include <array>
#include <cmath>

#include "stereo_nav/eval/evaluation.h"

namespace stereo_nav::eval {
namespace {

std::string cell(double value) {
  if (!std::isfinite(value)) return "";
  return fmt::format("{:.9g}", value);
}

/// Text as a field of a CSV file.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

/// Names of the upper triangle of a covariance, row by row: translation in m, then rotation about the axes in
/// rad.
std::string covarianceNames() {
  constexpr std::array<const char*, 6> kAxes = {"x", "y", "z", "rx", "ry", "rz"};
  std::string names;
  for (std::size_t row = 0; row < kAxes.size(); ++row) {
    for (std::size_t column = row; column < kAxes.size(); ++column)
      names += fmt::format(",cov_{}_{}", kAxes[row], kAxes[column]);
  }
  return names;
}

std::string covarianceCells(const std::optional<Matrix6d>& covariance) {
  std::string cells;
  for (Eigen::Index row = 0; row < 6; ++row) {
    for (Eigen::Index column = row; column < 6; ++column)
      cells += "," + cell(covariance ? (*covariance)(row, column) : EvaluationSummary::kUnknown);
  }
  return cells;
}

}  // namespace

std::string toCsv(const std::vector<FrameErrors>& frames) {
  std::string text =
      "time_s,lost,features,inliers,x_m,y_m,z_m,true_x_m,true_y_m,true_z_m,absolute_error_m,rotation_error_deg,"
      "reason" +
      covarianceNames() + "\n";
  for (const FrameErrors& frame : frames) {
    const Eigen::Vector3d truth =
        frame.ground_truth_m.value_or(Eigen::Vector3d::Constant(EvaluationSummary::kUnknown));
    text += cell(frame.time_s) + (frame.lost ? ",1," : ",0,") + std::to_string(frame.features) + "," +
            std::to_string(frame.inliers);
    for (const double value : {frame.position_m.x(), frame.position_m.y(), frame.position_m.z(), truth.x(),
                               truth.y(), truth.z(), frame.absolute_error_m, frame.rotation_error_deg}) {
      text += "," + cell(value);
    }
    text += "," + quoted(frame.reason) + covarianceCells(frame.pose_covariance) + "\n";
  }
  return text;
}

}  // namespace stereo_nav::eval
