// `plan` as its users run it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "import_test_support.h"
#include "navigation/planner/path_file.h"
#include "support/command.h"

namespace stereo_nav::tools {
namespace {

/// The contest's field as people draw it: 6 x 11.4 m, 10 mm a pixel, black fences on a white floor, with a
/// red area.
class PlanProgram : public ::testing::Test {
 protected:
  PlanProgram() {
    cv::Mat_<cv::Vec3b> drawing(1140, 600, cv::Vec3b(255, 255, 255));
    drawing.rowRange(0, 300).setTo(cv::Scalar(60, 60, 230));
    cv::line(drawing, {0, 740}, {450, 740}, cv::Scalar(0, 0, 0), 2);
    cv::line(drawing, {150, 380}, {599, 380}, cv::Scalar(0, 0, 0), 2);
    cv::imwrite(folder_ / "field.png", drawing);
  }
  test::CommandResult plan(const std::string& arguments) const {
    return test::runCommand(std::string("ROS_PACKAGE_PATH=") + STEREO_NAV_SOURCE_DIR + " " + PLAN + " " +
                            arguments);
  }

  const std::string robot_ = " --set footprint_length_m=0.65 --set footprint_width_m=0.65 --set heading=kept";
  TemporaryFolder folder_;
};

TEST_F(PlanProgram, PlansOnADrawingAndWritesPictureAndBothForms) {
  const auto result =
      plan((folder_ / "field.png") + robot_ +
           " --metres-per-pixel 0.01 --start=0.55,0.35 --goal=4.3,10.0 --image " + (folder_ / "path.png") +
           " --csv " + (folder_ / "path.csv") + " --text " + (folder_ / "path.txt"));
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("path of 16."), std::string::npos) << result.output;
  const auto poses = navigation::readPath(folder_ / "path.csv");
  EXPECT_LE(poses.size(), 20U);
  EXPECT_NEAR((poses.back().position_m - Eigen::Vector2d(4.3, 10.0)).norm(), 0.0, 1e-3);
  std::ifstream text(folder_ / "path.txt");
  std::string first, last, line;
  std::getline(text, first);
  while (std::getline(text, line)) last = line;
  EXPECT_EQ(first, "550 350");
  EXPECT_EQ(last, "4300 10000");
  EXPECT_FALSE(cv::imread(folder_ / "path.png").empty());
}

TEST_F(PlanProgram, PlansAsPublishedForComparison) {
  const auto result = plan((folder_ / "field.png") + robot_ +
                           " --start=0.55,0.35 --goal=4.3,10.0 --as-published --thin-every 40");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("nothing keeps its thinned path off the obstacles"), std::string::npos)
      << result.output;
}

TEST_F(PlanProgram, SaysWhyThereIsNoPathOrWhatItCannotUse) {
  auto result = plan((folder_ / "field.png") + robot_ + " --start=0.55,0.35 --goal=3.0,4.0");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.output.find("the nearest point that it can reach"), std::string::npos) << result.output;
  result = plan(folder_ / "field.png");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.output.find("--start=X,Y"), std::string::npos) << result.output;
  result = plan((folder_ / "none.yaml") + " --start=0,0 --goal=1,1");
  EXPECT_EQ(result.status, 2);
  result = plan((folder_ / "field.png") + " --start=1,1 --goal=2,2 --set heading=sideways");
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.output.find("heading"), std::string::npos) << result.output;
}

TEST_F(PlanProgram, RunsABenchmarksScenarios) {
  std::ofstream(folder_ / "small.map") << "type octile\nheight 3\nwidth 3\nmap\n...\n.@.\n...\n";
  std::ofstream(folder_ / "small.map.scen")
      << "version 1\n0\tsmall.map\t3\t3\t0\t0\t2\t2\t4\n0\tsmall.map\t3\t3\t0\t0\t2\t0\t2\n";
  auto result = plan("--scenarios " + (folder_ / "small.map.scen"));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("solved 2 of 2, with the optimal length 2"), std::string::npos)
      << result.output;
  std::ofstream(folder_ / "small.map.scen") << "version 1\n0\tsmall.map\t3\t3\t0\t0\t2\t2\t3.5\n";
  EXPECT_EQ(plan("--scenarios " + (folder_ / "small.map.scen")).status, 1)
      << "a length that is not the file's";
}

}  // namespace
}  // namespace stereo_nav::tools
