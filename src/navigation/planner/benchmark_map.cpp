#include "navigation/planner/benchmark_map.h"

#include <fmt/format.h>

#include <sstream>

#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::navigation {
namespace {

bool isFree(char cell) {
  return cell == '.' || cell == 'G' || cell == 'S';
}

}  // namespace

cv::Mat_<std::uint8_t> readBenchmarkMap(const std::string& path) {
  std::istringstream text(readTextFile(path));
  std::string type, octile, height_word, width_word, map_word;
  int height = 0, width = 0;
  text >> type >> octile >> height_word >> height >> width_word >> width >> map_word;
  if (!text || type != "type" || height_word != "height" || width_word != "width" || map_word != "map" ||
      height < 1 || width < 1 || height > 65535 || width > 65535) {
    throw InputError(
        path +
        ": not a map of the grid benchmark, which begins with `type octile`, `height N`, `width N`, `map`");
  }
  cv::Mat_<std::uint8_t> obstacles(height, width, std::uint8_t{1});
  for (int y = 0; y < height; ++y) {
    std::string row;
    text >> row;
    if (static_cast<int>(row.size()) != width)
      throw InputError(fmt::format("{}:{}: {} cells instead of {}; the file is cut off or damaged", path,
                                   y + 5, row.size(), width));
    for (int x = 0; x < width; ++x) obstacles(y, x) = isFree(row[static_cast<std::size_t>(x)]) ? 0 : 1;
  }
  return obstacles;
}

std::vector<BenchmarkScenario> readBenchmarkScenarios(const std::string& path) {
  std::vector<BenchmarkScenario> scenarios;
  for (const TextRow& row : readTextTable(path)) {
    if (row.fields.front() == "version") continue;
    if (row.fields.size() < 9) {
      throw InputError(
          row.source +
          ": not a scenario, which is `bucket map width height start_x start_y goal_x goal_y length`");
    }
    const std::size_t n = row.fields.size();  // counted from the end, since a map's name may have blanks
    BenchmarkScenario scenario;
    scenario.map = row.fields[1];
    for (std::size_t i = 2; i + 7 < n; ++i) scenario.map += " " + row.fields[i];
    scenario.start = {static_cast<int>(row.integer(n - 5)), static_cast<int>(row.integer(n - 4))};
    scenario.goal = {static_cast<int>(row.integer(n - 3)), static_cast<int>(row.integer(n - 2))};
    scenario.optimal_length = row.number(n - 1);
    scenarios.push_back(scenario);
  }
  return scenarios;
}

}  // namespace stereo_nav::navigation
