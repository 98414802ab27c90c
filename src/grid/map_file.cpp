#include "grid/map_file.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "core/atomic_file.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::grid {
namespace {

namespace fs = std::filesystem;

/// A value of the YAML file; messages begin with its name.
template <class Value>
Value entry(const YAML::Node& map, const std::string& file, const std::string& name) {
  const YAML::Node node = map[name];
  if (!node.IsDefined())
    throw InputError(file + ": `" + name + "` is missing; is this the YAML file of a map?");
  try {
    return node.as<Value>();
  } catch (const YAML::Exception&) {
    throw InputError(fmt::format(
        "{}:{}: `{}` cannot be used; map_server's format has e.g. `resolution: 0.05`, `origin: [-10.0, -5.0, "
        "0.0]`, `negate: 0`",
        file, node.Mark().line + 1, name));
  }
}

bool negated(const YAML::Node& map, const std::string& file) {
  const auto text = entry<std::string>(map, file, "negate");
  if (text == "0" || text == "1") return text == "1";
  return entry<bool>(map, file, "negate");
}

MapMode modeOf(const YAML::Node& map, const std::string& file) {
  if (!map["mode"].IsDefined()) return MapMode::kTrinary;
  const auto name = entry<std::string>(map, file, "mode");
  if (name == "trinary") return MapMode::kTrinary;
  if (name == "scale") return MapMode::kScale;
  if (name == "raw") return MapMode::kRaw;
  throw InputError(file + ": `mode` is '" + name + "'; it is trinary, scale or raw");
}

MapImageParams imageParams(const YAML::Node& map, const std::string& file) {
  MapImageParams params;
  params.mode = modeOf(map, file);
  params.negate = negated(map, file);
  params.occupied_thresh = entry<double>(map, file, "occupied_thresh");
  params.free_thresh = entry<double>(map, file, "free_thresh");
  if (!(params.free_thresh < params.occupied_thresh)) {
    throw InputError(
        fmt::format("{}: `free_thresh` is {} and `occupied_thresh` {}; the first must be smaller", file,
                    params.free_thresh, params.occupied_thresh));
  }
  return params;
}

GridGeometry geometryOf(const YAML::Node& map, const std::string& file) {
  GridGeometry geometry;
  geometry.resolution_m = entry<double>(map, file, "resolution");
  if (!(geometry.resolution_m > 0.0))
    throw InputError(file + ": `resolution` must be above zero, in m a pixel");
  const auto origin = entry<std::vector<double>>(map, file, "origin");
  if (origin.size() != 3 || !std::isfinite(origin[0] + origin[1] + origin[2]))
    throw InputError(file + ": `origin` must be three numbers, x and y in m and the yaw in rad");
  geometry.origin_x_m = origin[0];
  geometry.origin_y_m = origin[1];
  geometry.origin_yaw_rad = origin[2];
  return geometry;
}

}  // namespace

cv::Mat readMapImage(const std::string& path) {
  cv::Mat image = cv::imread(path, cv::IMREAD_UNCHANGED);
  if (image.empty()) {
    throw InputError(path + (fs::exists(path) ? ": no image that can be read; PGM and PNG can"
                                              : ": there is no such image file"));
  }
  if (image.cols > 65535 || image.rows > 65535) {
    throw InputError(fmt::format("{}: {} x {} pixels; a side of a map has 65535 cells at most", path,
                                 image.cols, image.rows));
  }
  return image;
}

OccupancyGrid loadMap(const std::string& yaml_path) {
  const YAML::Node map = loadYamlFile(yaml_path);
  if (!map.IsMap())
    throw InputError(yaml_path + ": not the YAML file of a map, which begins with `image: FILE`");
  const MapImageParams params = imageParams(map, yaml_path);
  OccupancyGrid grid;
  grid.geometry = geometryOf(map, yaml_path);
  const fs::path image_path = fs::path(yaml_path).parent_path() / entry<std::string>(map, yaml_path, "image");
  const cv::Mat image = readMapImage(image_path.string());
  grid.geometry.width = image.cols;
  grid.geometry.height = image.rows;
  grid.cells = cellsOfImage(image, params);
  return grid;
}

void saveMap(const OccupancyGrid& grid, const std::string& yaml_path, MapMode mode,
             const std::string& image_extension) {
  const cv::Mat_<std::uint8_t> image = imageOfCells(grid, mode);
  const fs::path image_path = fs::path(yaml_path).replace_extension(image_extension);
  std::vector<std::uint8_t> bytes;
  if ((image_extension != ".pgm" && image_extension != ".png") ||
      !cv::imencode(image_extension, image, bytes))
    throw InputError("a map's image is a .pgm or a .png file, not '" + image_extension + "'");
  writeFileAtomically(image_path.string(), std::string(bytes.begin(), bytes.end()));
  const GridGeometry& geometry = grid.geometry;
  std::string text = fmt::format(
      "image: {}\nresolution: {}\norigin: [{}, {}, {}]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n",
      image_path.filename().string(), geometry.resolution_m, geometry.origin_x_m, geometry.origin_y_m,
      geometry.origin_yaw_rad);
  if (mode == MapMode::kRaw) text += "mode: raw\n";
  writeFileAtomically(yaml_path, text);
}

}  // namespace stereo_nav::grid
