#include "grid/map_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::grid {
namespace {

constexpr std::uint8_t kFreePixel = 254, kOccupiedPixel = 0, kUnknownPixel = 205;

/// Colours of 8 bits, whatever the file has.
cv::Mat eightBits(const cv::Mat& image) {
  if (image.depth() == CV_8U) return image;
  if (image.depth() != CV_16U) throw InputError("an image with 8 or 16 bits a colour is needed");
  cv::Mat converted;
  image.convertTo(converted, CV_8U, 1.0 / 257.0);
  return converted;
}

/// Mean of the first `channels` of a pixel.
double brightness(const std::uint8_t* pixel, int channels) {
  int sum = 0;
  for (int c = 0; c < channels; ++c) sum += pixel[c];
  return static_cast<double>(sum) / channels;
}

std::int8_t occupancy(double bright, bool transparent, const MapImageParams& params) {
  if (params.negate) bright = 255.0 - bright;
  if (params.mode == MapMode::kRaw) return bright <= 100.0 ? static_cast<std::int8_t>(bright) : kUnknown;
  const double darkness = (255.0 - bright) / 255.0;
  if (darkness > params.occupied_thresh) return kOccupied;
  if (darkness < params.free_thresh) return kFree;
  if (params.mode == MapMode::kTrinary || transparent) return kUnknown;
  const double share = (darkness - params.free_thresh) / (params.occupied_thresh - params.free_thresh);
  return static_cast<std::int8_t>(99.0 * share);
}

bool isBlack(const std::uint8_t* pixel, int channels, int black_below) {
  const int colours = channels >= 3 ? 3 : 1;
  if (colours < channels && pixel[channels - 1] == 0) return false;  // nothing is drawn here
  return *std::max_element(pixel, pixel + colours) < black_below;
}

}  // namespace

std::vector<std::int8_t> cellsOfImage(const cv::Mat& image, const MapImageParams& params) {
  const cv::Mat pixels = eightBits(image);
  const int channels = pixels.channels();
  const bool has_alpha = channels == 2 || channels == 4;
  const int averaged = has_alpha && params.mode != MapMode::kTrinary ? channels - 1 : channels;
  std::vector<std::int8_t> cells;
  cells.reserve(pixels.total());
  for (int row = pixels.rows - 1; row >= 0; --row) {
    const std::uint8_t* pixel = pixels.ptr<std::uint8_t>(row);
    for (int x = 0; x < pixels.cols; ++x, pixel += channels) {
      const bool transparent = has_alpha && pixel[channels - 1] == 0;
      cells.push_back(occupancy(brightness(pixel, averaged), transparent, params));
    }
  }
  return cells;
}

cv::Mat_<std::uint8_t> imageOfCells(const OccupancyGrid& grid, MapMode mode) {
  if (mode == MapMode::kScale)
    throw InputError("maps are written as trinary or raw; scale is for reading only");
  cv::Mat_<std::uint8_t> image(grid.geometry.height, grid.geometry.width);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const std::int8_t value = grid.at({x, y});
      std::uint8_t& pixel = image(image.rows - 1 - y, x);
      if (mode == MapMode::kRaw) {
        pixel = value < 0 ? 255 : static_cast<std::uint8_t>(value);
      } else {
        pixel = value == kFree ? kFreePixel : value == kOccupied ? kOccupiedPixel : kUnknownPixel;
      }
    }
  }
  return image;
}

OccupancyGrid gridOfDrawing(const cv::Mat& image, const DrawingParams& params) {
  const cv::Mat pixels = eightBits(image);
  if (!(params.metres_per_pixel > 0.0 && params.resolution_m > 0.0))
    throw InputError("the sizes of pixels and cells must be above zero");
  const double cells_per_pixel = params.metres_per_pixel / params.resolution_m;
  GridGeometry geometry;
  geometry.resolution_m = params.resolution_m;
  geometry.width = static_cast<int>(std::ceil(pixels.cols * cells_per_pixel - 1e-6));
  geometry.height = static_cast<int>(std::ceil(pixels.rows * cells_per_pixel - 1e-6));
  if (geometry.width > 20000 || geometry.height > 20000) {
    throw InputError(
        fmt::format("the drawing of {} x {} pixels would have {} x {} cells; is --metres-per-pixel right?",
                    pixels.cols, pixels.rows, geometry.width, geometry.height));
  }
  OccupancyGrid grid(geometry, kFree);
  const int channels = pixels.channels();
  for (int row = 0; row < pixels.rows; ++row) {
    const int from_bottom = pixels.rows - 1 - row;
    const int y0 = static_cast<int>(from_bottom * cells_per_pixel + 1e-6);
    const int y1 =
        std::min(geometry.height - 1, static_cast<int>((from_bottom + 1) * cells_per_pixel - 1e-6));
    const std::uint8_t* pixel = pixels.ptr<std::uint8_t>(row);
    for (int column = 0; column < pixels.cols; ++column, pixel += channels) {
      if (!isBlack(pixel, channels, params.black_below)) continue;
      const int x0 = static_cast<int>(column * cells_per_pixel + 1e-6);
      const int x1 = std::min(geometry.width - 1, static_cast<int>((column + 1) * cells_per_pixel - 1e-6));
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) grid.at({x, y}) = kOccupied;
    }
  }
  return grid;
}

}  // namespace stereo_nav::grid
