#include "grid/map_image.h"

#include <gtest/gtest.h>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::grid {
namespace {

std::vector<int> cells(const cv::Mat& image, const MapImageParams& params) {
  const auto values = cellsOfImage(image, params);
  return {values.begin(), values.end()};
}

TEST(CellsOfAnImage, AreTrinaryAsInMapServer) {
  const cv::Mat_<std::uint8_t> image = (cv::Mat_<std::uint8_t>(2, 3) << 0, 205, 254, 89, 90, 206);
  // The lower row comes first. Darkness above 0.65 is occupied, below 0.196 free.
  EXPECT_EQ(cells(image, {}), (std::vector<int>{100, -1, 0, 100, -1, 0}));
  MapImageParams negated;
  negated.negate = true;
  EXPECT_EQ(cells(image, negated), (std::vector<int>{-1, -1, 100, 0, 100, 100}));
}

TEST(CellsOfAnImage, AreScaledBetweenTheThresholds) {
  MapImageParams params;
  params.mode = MapMode::kScale;
  params.free_thresh = 0.2;
  params.occupied_thresh = 0.6;
  // Darkness 0.4 is half way: 99 / 2 = 49.
  const cv::Mat_<std::uint8_t> image = (cv::Mat_<std::uint8_t>(1, 3) << 153, 255, 0);
  EXPECT_EQ(cells(image, params), (std::vector<int>{49, 0, 100}));
  const cv::Mat_<cv::Vec4b> transparent(1, 1, cv::Vec4b(153, 153, 153, 0)),
      opaque(1, 1, cv::Vec4b(153, 153, 153, 255));
  EXPECT_EQ(cells(transparent, params), std::vector<int>{-1});
  EXPECT_EQ(cells(opaque, params), std::vector<int>{49});
}

TEST(CellsOfAnImage, AreTheirBrightnessInRawMode) {
  MapImageParams params;
  params.mode = MapMode::kRaw;
  const cv::Mat_<std::uint8_t> image = (cv::Mat_<std::uint8_t>(1, 4) << 0, 42, 100, 255);
  EXPECT_EQ(cells(image, params), (std::vector<int>{0, 42, 100, -1}));
}

TEST(CellsOfAnImage, AverageColoursAndTakeSixteenBits) {
  const cv::Mat_<cv::Vec3b> red(1, 1, cv::Vec3b(0, 0, 255));  // darkness 2/3
  EXPECT_EQ(cells(red, {}), std::vector<int>{100});
  const cv::Mat_<std::uint16_t> deep = (cv::Mat_<std::uint16_t>(1, 2) << 0, 65535);
  EXPECT_EQ(cells(deep, {}), (std::vector<int>{100, 0}));
}

TEST(ImageOfCells, GivesTheSameCellsBack) {
  GridGeometry geometry;
  geometry.width = 3;
  geometry.height = 2;
  OccupancyGrid grid(geometry);
  grid.cells = {0, 100, -1, -1, 0, 100};
  EXPECT_EQ(cellsOfImage(imageOfCells(grid, MapMode::kTrinary), {}), grid.cells);
  grid.cells = {0, 17, -1, 99, 100, 50};
  MapImageParams raw;
  raw.mode = MapMode::kRaw;
  EXPECT_EQ(cellsOfImage(imageOfCells(grid, MapMode::kRaw), raw), grid.cells);
}

TEST(GridOfADrawing, HasBlackAsObstaclesAndColoursAsFloor) {
  cv::Mat_<cv::Vec3b> drawing(114, 60, cv::Vec3b(255, 255, 255));
  drawing.rowRange(0, 20).setTo(cv::Scalar(0, 0, 255));  // a red area
  drawing.col(33).setTo(cv::Scalar(20, 20, 20));         // a line of one pixel
  DrawingParams params;
  params.metres_per_pixel = 0.01;
  params.resolution_m = 0.025;
  const OccupancyGrid grid = gridOfDrawing(drawing, params);
  EXPECT_EQ(grid.geometry.width, 24);
  EXPECT_EQ(grid.geometry.height, 46);  // 45.6
  for (int y = 0; y < 46; ++y)
    for (int x = 0; x < 24; ++x) EXPECT_EQ(grid.at({x, y}), x == 13 ? kOccupied : kFree) << x << " " << y;
}

TEST(GridOfADrawing, RefusesSizesThatCannotBe) {
  const cv::Mat_<std::uint8_t> drawing(10, 10, std::uint8_t{255});
  EXPECT_THROW(gridOfDrawing(drawing, {0.0, 0.025, 100}), InputError);
  EXPECT_THROW(gridOfDrawing(drawing, {1e6, 0.025, 100}), InputError);
}

}  // namespace
}  // namespace stereo_nav::grid
