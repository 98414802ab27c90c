// `find_loops` as its users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "import_test_support.h"
#include "support/command.h"
#include "support/fixture_bag.h"
#include "support/textured_room.h"

namespace stereo_nav::tools {
namespace {

class FindLoopsProgram : public ::testing::Test {
 protected:
  test::CommandResult findLoops(const std::string& arguments) const {
    return test::runCommand(std::string("ROS_PACKAGE_PATH=") + STEREO_NAV_SOURCE_DIR + " " + FIND_LOOPS +
                            " " + arguments + " --output " + (folder_ / "loops"));
  }
  nlohmann::json summary() const {
    std::ifstream file(folder_ / "loops/summary.json");
    return nlohmann::json::parse(file);
  }
  std::string listed() const {
    std::ifstream file(folder_ / "loops/loops.csv");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TemporaryFolder folder_;
};

/// Turns once around in the room, and once more.
TEST_F(FindLoopsProgram, KnowsTheSecondTurnOfOneCamera) {
  constexpr int kTurn = 12;
  std::filesystem::create_directory(folder_ / "images");
  for (int i = 0; i < 2 * kTurn; ++i) {
    Eigen::Isometry3d T_room_camera = test::roomDrive(0.0);
    T_room_camera.rotate(
        Eigen::AngleAxisd(2.0 * M_PI * (i + (i < kTurn ? 0.0 : 0.05)) / kTurn, Eigen::Vector3d::UnitY()));
    const cv::Mat image = test::TexturedRoom().render(T_room_camera, 277.0, 277.0, 160.0, 120.0, {320, 240});
    cv::imwrite(folder_ / ("images/" + std::to_string(i) + ".png"), image);
  }
  const auto result = findLoops((folder_ / "images") + " --same-after 12 --same-within 1 --pictures 2");
  ASSERT_EQ(result.status, 0) << result.output;
  const nlohmann::json found = summary();
  EXPECT_EQ(found["keyframes"], 2 * kTurn);
  EXPECT_EQ(found["revisits"], kTurn + 1);
  EXPECT_GE(found["first_is_same"], kTurn - 1);
  EXPECT_GE(found["recognised"], kTurn - 2);
  EXPECT_EQ(found["false_accepted"], 0);
  EXPECT_NE(listed().find("\n24,12,23.png,11.png,"), std::string::npos) << listed();
  int pictures = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "loops")) {
    if (entry.path().extension() == ".png") ++pictures;
  }
  EXPECT_EQ(pictures, 2);
}

TEST_F(FindLoopsProgram, ADriveStraightOnHasNoLoopAndTwoRunsGiveTheSameBytes) {
  test::writeFixtureBag(folder_ / "room.bag", {});
  ASSERT_EQ(findLoops(folder_ / "room.bag").status, 0);
  const std::string first = listed();
  EXPECT_EQ(summary()["accepted"], 0);
  EXPECT_GE(summary()["keyframes"], 2);
  const auto result = findLoops(folder_ / "room.bag");
  EXPECT_EQ(listed(), first);
  EXPECT_NE(result.output.find("0 loops accepted"), std::string::npos) << result.output;
}

TEST_F(FindLoopsProgram, SaysInOneLineWhatCannotBeUsed) {
  std::filesystem::create_directory(folder_ / "empty");
  std::ofstream(folder_ / "empty/broken.png") << "no image";
  for (const auto& [arguments, said] :
       {std::pair<std::string, std::string>{"", "no BAG or FOLDER given"},
        {folder_ / "absent.bag", "no such file or folder"},
        {folder_ / "empty", "broken.png: cannot be read as an image"},
        {(folder_ / "empty") + " --same-after 4,x", "--same-after must be numbers of images"}}) {
    const auto result = findLoops(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_NE(result.output.find(said), std::string::npos) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  }
}

TEST_F(FindLoopsProgram, KnowsTheSecondLapOfACorridorOfLikeDoors) {
  const char* data = std::getenv("STEREO_NAV_DATA");
  if (data == nullptr) GTEST_SKIP() << "STEREO_NAV_DATA is not set";
  const auto result = findLoops(std::string(data) + "/corridor_two_laps --same-after 40,80 --pictures 0");
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_GE(summary()["first_is_same"], 44);
  EXPECT_GE(summary()["recognised"], 40);
  EXPECT_EQ(summary()["false_accepted"], 0);
}

}  // namespace
}  // namespace stereo_nav::tools
