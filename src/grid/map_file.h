#pragma once

#include <string>

#include "grid/map_image.h"

namespace stereo_nav::grid {

/// Reads a map of map_server's format: a YAML file with `image` (PGM, PNG or whatever OpenCV reads, beside
/// the YAML file unless the path is absolute), `resolution` (m), `origin` [x m, y m, yaw rad], `negate`,
/// `occupied_thresh`, `free_thresh` and, if it is not trinary, `mode`. Throws InputError that names the file
/// and what is wrong with it.
OccupancyGrid loadMap(const std::string& yaml_path);

/// Writes YAML_PATH and beside it the image, of the same name with `.pgm`, or `.png` where `image_extension`
/// says so, as map_saver does. The YAML file appears last. Throws InputError.
void saveMap(const OccupancyGrid& grid, const std::string& yaml_path, MapMode mode = MapMode::kTrinary,
             const std::string& image_extension = ".pgm");

/// Reads an image file for map_image.h. Throws InputError.
cv::Mat readMapImage(const std::string& path);

}  // namespace stereo_nav::grid
