#include "navigation/planner/path_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/angles.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::navigation {
namespace {

class PathFile : public testing::Test {
 protected:
  ~PathFile() override { std::filesystem::remove(file_); }
  std::vector<PlanarPose> read(const std::string& text) {
    std::ofstream(file_) << text;
    return readPath(file_);
  }
  const std::string file_ =
      (std::filesystem::temp_directory_path() / ("path_file_test_" + std::to_string(getpid()))).string();
  const std::vector<PlanarPose> poses_{{{0.55, 0.35}, 0.1}, {{4.3, 0.35}, 0.2}, {{4.3, 10.0}, 0.3}};
};

TEST_F(PathFile, OfOurFormIsReadAsWritten) {
  EXPECT_EQ(toCsv(poses_),
            "x_m,y_m,heading_rad\n0.5500,0.3500,0.10000\n4.3000,0.3500,0.20000\n4.3000,10.0000,0.30000\n");
  const auto read_poses = read(toCsv(poses_));
  ASSERT_EQ(read_poses.size(), 3U);
  EXPECT_NEAR((read_poses[2].position_m - poses_[2].position_m).norm(), 0.0, 1e-9);
  EXPECT_NEAR(read_poses[1].heading_rad, 0.2, 1e-9);
}

TEST_F(PathFile, OfThePublishedFormIsInMillimetresAndHasItsHeadingsFromItsWays) {
  EXPECT_EQ(toPublishedText(poses_), "550 350\n4300 350\n4300 10000\n");
  const auto read_poses = read(toPublishedText(poses_));
  ASSERT_EQ(read_poses.size(), 3U);
  EXPECT_NEAR((read_poses[2].position_m - poses_[2].position_m).norm(), 0.0, 1e-9);
  EXPECT_NEAR(read_poses[0].heading_rad, 0.0, 1e-9);
  EXPECT_NEAR(read_poses[1].heading_rad, kPi / 2.0, 1e-9);
  EXPECT_NEAR(read_poses[2].heading_rad, kPi / 2.0, 1e-9);
}

TEST_F(PathFile, InCsvWithoutHeadingsHasThemFromItsWays) {
  const auto read_poses = read("x_m,y_m\n0,0\n1.5,0\n1.5,2\n");
  ASSERT_EQ(read_poses.size(), 3U);
  EXPECT_EQ(read_poses[2].position_m, Eigen::Vector2d(1.5, 2.0));
  EXPECT_NEAR(read_poses[0].heading_rad, 0.0, 1e-9);
  EXPECT_NEAR(read_poses[1].heading_rad, kPi / 2.0, 1e-9);
}

TEST_F(PathFile, ThatCannotBeUsedIsNamedWithItsLine) {
  try {
    read("x_m,y_m\n0,0\n1,a\n");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(":3"), std::string::npos) << error.what();
  }
  EXPECT_THROW(read(""), InputError);
  EXPECT_THROW(read("x_m,y_m,heading_rad\n"), InputError);
  EXPECT_THROW(read("550 north\n"), InputError);
  EXPECT_THROW(read("x_m,y_m,heading_rad\n1,2\n"), InputError);
}

}  // namespace
}  // namespace stereo_nav::navigation
