#pragma once

#include <opencv2/core.hpp>

#include "grid/occupancy_grid.h"

namespace stereo_nav::grid {

/// How map_server turns brightness into occupancy (http://wiki.ros.org/map_server, "Value Interpretation").
enum class MapMode {
  kTrinary,  ///< free, occupied or unknown
  kScale,    ///< values between the thresholds become 1 to 99; there, transparent pixels are unknown
  kRaw,      ///< the brightness is the value; above 100 it is unknown
};

struct MapImageParams {
  MapMode mode = MapMode::kTrinary;
  bool negate = false;            ///< bright is occupied
  double occupied_thresh = 0.65;  ///< occupied above this share of darkness
  double free_thresh = 0.196;     ///< free below
};

/// Cells of an image as map_server reads it; its top row is the last row of the grid. `image`: 8 or 16 bits,
/// grey, colour, or with alpha, whose channels are averaged (in mode kTrinary the alpha, too, as map_server
/// does).
std::vector<std::int8_t> cellsOfImage(const cv::Mat& image, const MapImageParams& params);

/// The image that map_saver writes: CV_8UC1, 254 for free, 0 for occupied, 205 for all else; in mode kRaw the
/// values themselves, 255 where unknown, which loses nothing. kScale is for reading only.
cv::Mat_<std::uint8_t> imageOfCells(const OccupancyGrid& grid, MapMode mode);

/// A drawing of a field, as people make it: black is an obstacle, all else (white floor, coloured marks) is
/// floor.
struct DrawingParams {
  double metres_per_pixel = 0.01;
  double resolution_m = 0.025;  ///< of the grid
  int black_below = 100;        ///< a pixel is black if each of its colours is below this, of 255
};

/// The grid of a drawing, with its lower left corner as the origin. A cell is occupied when a black pixel
/// reaches into it: the finest line stays an obstacle at any resolution. Throws InputError when a number is
/// not positive or the drawing has less than one cell.
OccupancyGrid gridOfDrawing(const cv::Mat& image, const DrawingParams& params);

}  // namespace stereo_nav::grid
