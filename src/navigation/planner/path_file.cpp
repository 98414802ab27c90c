#include "navigation/planner/path_file.h"

#include <fmt/format.h>

#include <cmath>

#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::navigation {
namespace {

const std::string kCsvX = "x_m", kCsvHeading = kCsvX + ",y_m,heading_rad\n";
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
  std::vector<TextRow> rows = readTextTable(path);
  const bool is_csv = !rows.empty() && rows.front().fields.front() == kCsvX;
  const bool has_headings = is_csv && rows.front().fields.size() > 2;
  if (is_csv) rows.erase(rows.begin());
  std::vector<PlanarPose> poses;
  for (const TextRow& row : rows) {
    PlanarPose pose;
    pose.position_m = Eigen::Vector2d(row.number(0), row.number(1)) * (is_csv ? 1.0 : kMetresPerMillimetre);
    if (has_headings) pose.heading_rad = row.number(2);
    poses.push_back(pose);
  }
  if (poses.empty())
    throw InputError(
        path +
        ": no points; a path is `x_m,y_m` or `x_m,y_m,heading_rad` below that heading, or `x y` in mm, a line each");
  if (!has_headings) setHeadingsAlong(poses);
  return poses;
}

}  // namespace stereo_nav::navigation
