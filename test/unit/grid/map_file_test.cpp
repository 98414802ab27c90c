#include "grid/map_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/angles.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::grid {
namespace {

class MapFile : public testing::Test {
 protected:
  MapFile()
      : folder_(std::filesystem::temp_directory_path() / ("map_file_test_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~MapFile() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }
  /// What loading the file says.
  std::string refusal(const std::string& name) const {
    try {
      loadMap(path(name));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

TEST_F(MapFile, OfMapSaverIsRead) {
  write("map.pgm", std::string("P5\n# CREATOR: map_saver.cpp 0.050 m/pix\n2 2\n255\n") + '\xFE' + '\xCD' +
                       std::string(1, '\0') + '\xFE');
  write(
      "map.yaml",
      "image: map.pgm\nresolution: 0.050000\norigin: [-1.000000, 2.000000, 1.570796]\nnegate: 0\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\n\n");
  const OccupancyGrid map = loadMap(path("map.yaml"));
  EXPECT_EQ(map.geometry.width, 2);
  EXPECT_EQ(map.geometry.height, 2);
  EXPECT_EQ(map.cells, (std::vector<std::int8_t>{kOccupied, kFree, kFree, kUnknown}));
  // With a yaw of 90 degrees, columns run along y and rows along -x.
  EXPECT_NEAR((map.geometry.centreOf({1, 0}) - Eigen::Vector2d(-1.025, 2.075)).norm(), 0.0, 1e-6);
  EXPECT_TRUE((map.geometry.cellAt({-1.025, 2.075}) == Cell{1, 0}));
}

TEST_F(MapFile, IsReadAsItWasSaved) {
  GridGeometry geometry;
  geometry.width = 3;
  geometry.height = 2;
  geometry.resolution_m = 0.025;
  geometry.origin_x_m = -12.3456789;
  geometry.origin_yaw_rad = 0.1;
  OccupancyGrid map(geometry);
  map.cells = {0, 100, -1, 100, 0, 37};
  for (const std::string extension : {".pgm", ".png"}) {
    saveMap(map, path("raw.yaml"), MapMode::kRaw, extension);
    const OccupancyGrid read = loadMap(path("raw.yaml"));
    EXPECT_EQ(read.cells, map.cells);
    EXPECT_EQ(read.geometry.origin_x_m, geometry.origin_x_m);
    EXPECT_EQ(read.geometry.origin_yaw_rad, geometry.origin_yaw_rad);
    EXPECT_EQ(read.geometry.resolution_m, geometry.resolution_m);
  }
  saveMap(map, path("trinary.yaml"));
  EXPECT_EQ(loadMap(path("trinary.yaml")).cells, (std::vector<std::int8_t>{0, 100, -1, 100, 0, -1}));
}

TEST_F(MapFile, ThatCannotBeUsedIsNamed) {
  EXPECT_NE(refusal("none.yaml").find("none.yaml"), std::string::npos);
  write(
      "a.yaml",
      "image: a.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  EXPECT_NE(refusal("a.yaml").find("there is no such image file"), std::string::npos);
  write("a.pgm", "no image");
  EXPECT_NE(refusal("a.yaml").find("no image that can be read"), std::string::npos);
  write("b.yaml", "image: a.pgm\nresolution: five\n");
  EXPECT_NE(refusal("b.yaml").find("`negate` is missing"), std::string::npos);
  write(
      "c.yaml",
      "image: a.pgm\nresolution: 0.05\norigin: [0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  EXPECT_NE(refusal("c.yaml").find("`origin` must be three numbers"), std::string::npos);
  write(
      "d.yaml",
      "image: a.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.1\nfree_thresh: 0.196\n");
  EXPECT_NE(refusal("d.yaml").find("must be smaller"), std::string::npos);
  write("e.yaml", "just text\n");
  EXPECT_NE(refusal("e.yaml").find("not the YAML file of a map"), std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::grid
