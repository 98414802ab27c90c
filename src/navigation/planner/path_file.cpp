#include "navigation/planner/path_file.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::navigation {
namespace {

const std::string kCsvHeading = "x_m,y_m,heading_rad\n";
constexpr double kMetresPerMillimetre = 1e-3;

void setHeadingsAlong(std::vector<PlanarPose>& poses) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i + 1 == poses.size()) {
      if (i > 0) poses[i].heading_rad = poses[i - 1].heading_rad;
      return;
    }
    const Eigen::Vector2d way = poses[i + 1].position_m - poses[i].position_m;
    poses[i].heading_rad = std::atan2(way.y(), way.x());
  }
}

}  // namespace

std::string toCsv(const std::vector<PlanarPose>& poses) {
  std::string text = kCsvHeading;
  for (const auto& pose : poses)
    text += fmt::format("{:.4f},{:.4f},{:.5f}\n", pose.position_m.x(), pose.position_m.y(), pose.heading_rad);
  return text;
}

std::string toPublishedText(const std::vector<PlanarPose>& poses) {
  std::string text;
  for (const auto& pose : poses)
    text += fmt::format("{:.0f} {:.0f}\n", pose.position_m.x() / kMetresPerMillimetre,
                        pose.position_m.y() / kMetresPerMillimetre);
  return text;
}

std::vector<PlanarPose> readPath(const std::string& path) {
  const std::string text = readTextFile(path);
  const bool is_csv = text.rfind(kCsvHeading.substr(0, 3), 0) == 0;
  std::istringstream lines(is_csv ? text.substr(std::min(text.size(), text.find('\n') + 1)) : text);
  std::vector<PlanarPose> poses;
  for (const TextRow& row : readTextTable(lines, path)) {
    PlanarPose pose;
    pose.position_m = Eigen::Vector2d(row.number(0), row.number(1)) * (is_csv ? 1.0 : kMetresPerMillimetre);
    if (is_csv) pose.heading_rad = row.number(2);
    poses.push_back(pose);
  }
  if (poses.empty())
    throw InputError(
        path +
        ": no points; a path is `x_m,y_m,heading_rad` below that heading, or `x y` in mm, a line each");
  if (!is_csv) setHeadingsAlong(poses);
  return poses;
}

}  // namespace stereo_nav::navigation
