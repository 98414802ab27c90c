#include "navigation/planner/benchmark_map.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::navigation {
namespace {

class BenchmarkFile : public testing::Test {
 protected:
  ~BenchmarkFile() override { std::filesystem::remove(file_); }
  std::string with(const std::string& text) {
    std::ofstream(file_) << text;
    return file_;
  }
  const std::string file_ =
      (std::filesystem::temp_directory_path() / ("benchmark_test_" + std::to_string(getpid()))).string();
};

TEST_F(BenchmarkFile, OfAMapHasItsFreeCells) {
  const auto map = readBenchmarkMap(with("type octile\nheight 2\nwidth 4\nmap\n.GS@\nTOW.\n"));
  const cv::Mat_<std::uint8_t> expected = (cv::Mat_<std::uint8_t>(2, 4) << 0, 0, 0, 1, 1, 1, 1, 0);
  EXPECT_EQ(cv::countNonZero(map != expected), 0);
}

TEST_F(BenchmarkFile, OfScenariosHasPlacesAndLengths) {
  const auto scenarios = readBenchmarkScenarios(
      with("version 1\n0\tmy map.map\t4\t2\t0\t1\t2\t0\t2.41421\n1\ta.map\t4\t2\t0\t1\t2\t1\t0\n"));
  ASSERT_EQ(scenarios.size(), 2U);
  EXPECT_EQ(scenarios[0].map, "my map.map");
  EXPECT_TRUE(scenarios[0].start == (grid::Cell{0, 1}));
  EXPECT_TRUE(scenarios[0].goal == (grid::Cell{2, 0}));
  EXPECT_EQ(scenarios[0].optimal_length, 2.41421);
  EXPECT_TRUE(scenarios[0].solvable());
  EXPECT_FALSE(scenarios[1].solvable());
}

TEST_F(BenchmarkFile, ThatCannotBeUsedIsNamed) {
  EXPECT_THROW(readBenchmarkMap(with("P5 2 2 255")), InputError);
  EXPECT_THROW(readBenchmarkMap(with("type octile\nheight 2\nwidth 4\nmap\n.GS@\nTO\n")), InputError);
  EXPECT_THROW(readBenchmarkScenarios(with("version 1\n0 a.map 4 2\n")), InputError);
}

}  // namespace
}  // namespace stereo_nav::navigation
