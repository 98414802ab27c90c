// The command line: exit status, one line of error, nothing half-written.
#include <algorithm>

#include "import_test_support.h"
#include "support/command.h"

namespace stereo_nav::tools {
namespace {

class ImportProgram : public ::testing::Test {
 protected:
  static test::CommandResult run(const std::string& arguments) {
    return test::runCommand(std::string(IMPORT_SEQUENCE) + " " + arguments);
  }

  /// Runs what must fail with status 2, one line, and no bag; returns the line.
  std::string failureOf(const std::string& arguments) {
    const auto result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      EXPECT_EQ(entry.path().string().find(".bag"), std::string::npos) << entry.path();
    }
    return result.output;
  }

  std::string to(const std::string& name) const { return folder_.path() + " --output " + (folder_ / name); }

  TemporaryFolder folder_;
};

TEST_F(ImportProgram, importsAndSaysHowMany) {
  writeKitti(folder_);
  const auto result = run("--format kitti " + to("out.bag") + " --every 2");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.output.find("out.bag: 2 pairs"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out.bag"));
}

TEST_F(ImportProgram, helpNamesEveryOption) {
  const auto [status, help] = run("--help");
  EXPECT_EQ(status, 0);
  for (const char* option : {"--format", "--output", "--every", "--right-lag-frames",
                             "--right-stamp-offset-ms", "--no-imu", "--base-frame"}) {
    EXPECT_NE(help.find(option), std::string::npos) << option;
  }
}

TEST_F(ImportProgram, refusesBadArguments) {
  writeKitti(folder_);
  const auto expect = [this](const std::string& arguments, const std::string& part) {
    const std::string line = failureOf(arguments);
    EXPECT_NE(line.find(part), std::string::npos) << line;
  };
  expect("", "--format must be euroc, kitti, kitti_raw, images, optiodom, carmen or monoslam");
  expect("--format rosbag " + to("out.bag"), "not 'rosbag'");
  expect("--format kitti --output " + (folder_ / "out.bag"), "no DIR given");
  expect("--format kitti " + folder_.path(), "no --output BAG given");
  expect("--format kitti " + to("out.bag") + " --every 0", "--every must be 1 or more");
  expect("--format kitti " + to("out.bag") + " --every x", "--help");
  expect("--format kitti " + to("out.bag") + " --right-lag-frames -1",
         "--right-lag-frames must be 0 or more");
  expect("--format kitti " + to("out.bag") + " --right-lag-frames 4", "no left image");
  expect("--format kitti " + to("out.bag") + " --right-stamp-offset-ms nan",
         "--right-stamp-offset-ms must lie");
  expect("--format kitti " + to("out.bag") + " --base-frame imu", "knows no IMU");
  expect("--format kitti " + to("out.bag") + " --base-frame wheel", "must be imu or camera");
  expect("--format kitti " + to("out.bag") + " --colour", "unrecognised option");
}

TEST_F(ImportProgram, refusesUnreadableInputAndUnwritableOutput) {
  EXPECT_NE(failureOf("--format kitti " + (folder_ / "absent") + " --output " + (folder_ / "out.bag"))
                .find("is no folder"),
            std::string::npos);
  EXPECT_NE(failureOf("--format kitti " + to("out.bag")).find("times.txt: cannot be read"),
            std::string::npos);
  writeKitti(folder_);
  EXPECT_NE(failureOf("--format kitti " + to("times.txt/out.b")).find("cannot be written"),
            std::string::npos);
  writeImage(folder_, "image_1/000002.png", frameOf(2, kWidth / 2));
  EXPECT_NE(failureOf("--format kitti " + to("out.bag")).find("is 32x48"), std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::tools
