#include "tools/plan/path_drawing.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stereo_nav::tools {
namespace {

constexpr int kLongerSide_px = 1000;
constexpr int kSubpixelBits = 4;
const cv::Scalar kPathColour(200, 80, 0), kOutlineColour(210, 170, 120), kStartColour(60, 160, 0),
    kGoalColour(40, 40, 220);

/// The canvas on which places of the map are drawn.
class Canvas {
 public:
  explicit Canvas(const grid::OccupancyGrid& map) : map_(map) {
    const grid::GridGeometry& geometry = map.geometry;
    scale_ = std::max(1, kLongerSide_px / std::max(geometry.width, geometry.height));
    cv::Mat_<std::uint8_t> cells(geometry.height, geometry.width);
    for (int y = 0; y < cells.rows; ++y) {
      for (int x = 0; x < cells.cols; ++x) {
        const std::int8_t value = map.at({x, y});
        cells(cells.rows - 1 - y, x) = value < 0 ? 180 : static_cast<std::uint8_t>(255 - value * 255 / 100);
      }
    }
    cv::Mat large;
    cv::resize(cells, large, cv::Size(), scale_, scale_, cv::INTER_NEAREST);
    cv::cvtColor(large, picture_, cv::COLOR_GRAY2BGR);
  }

  void outline(const grid::Polygon& corners_m, const cv::Scalar& colour) {
    lines(corners_m, true, colour, 1);
  }
  void lines(const grid::Polygon& places_m, bool closed, const cv::Scalar& colour, int width_px) {
    std::vector<cv::Point> points;
    for (const auto& place_m : places_m) points.push_back(pixel(place_m));
    cv::polylines(picture_, points, closed, colour, width_px, cv::LINE_AA, kSubpixelBits);
  }
  void dot(const Eigen::Vector2d& place_m, const cv::Scalar& colour, int radius_px) {
    cv::circle(picture_, pixel(place_m), radius_px << kSubpixelBits, colour, cv::FILLED, cv::LINE_AA,
               kSubpixelBits);
  }
  const cv::Mat& picture() const { return picture_; }

 private:
  cv::Point pixel(const Eigen::Vector2d& place_m) const {
    const Eigen::Vector2d cells = map_.geometry.inCells(place_m);
    const double factor = scale_ * (1 << kSubpixelBits);
    return {static_cast<int>(std::lround(cells.x() * factor)),
            static_cast<int>(std::lround((map_.geometry.height - cells.y()) * factor))};
  }

  const grid::OccupancyGrid& map_;
  int scale_ = 1;
  cv::Mat picture_;
};

}  // namespace

cv::Mat drawPath(const grid::OccupancyGrid& map, const grid::Footprint& footprint,
                 const std::vector<navigation::PlanarPose>& poses) {
  Canvas canvas(map);
  grid::Polygon places;
  for (const auto& pose : poses) {
    canvas.outline(footprint.at(pose.position_m, pose.heading_rad), kOutlineColour);
    places.push_back(pose.position_m);
  }
  canvas.lines(places, false, kPathColour, 2);
  for (const auto& place : places) canvas.dot(place, kPathColour, 3);
  if (!places.empty()) {
    canvas.dot(places.front(), kStartColour, 5);
    canvas.dot(places.back(), kGoalColour, 5);
  }
  return canvas.picture();
}

}  // namespace stereo_nav::tools
