#include "ros/package_files.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"
#include "support/trajectories.h"

namespace stereo_nav::ros_io {
namespace {

namespace fs = std::filesystem;

/// Names are looked up in the working folder first.
class PackageFiles : public testing::Test {
 protected:
  PackageFiles() { fs::current_path(folder_.path()); }
  ~PackageFiles() override { fs::current_path(before_); }

  const fs::path before_ = fs::current_path();
  const TemporaryFolder folder_;
};

TEST_F(PackageFiles, AFileHereGoesBeforeThePackages) {
  folder_.write("arena", "path: []");
  folder_.write("vo.yaml", "method: stereo");
  EXPECT_EQ(scenarioFile("arena"), "arena");
  EXPECT_EQ(configFile("vo.yaml"), "vo.yaml");
}

// `evaluate arena.bag --output arena` leaves one behind.
TEST_F(PackageFiles, AFolderHereIsNoFile) {
  fs::create_directory("arena");
  EXPECT_EQ(fs::path(scenarioFile("arena")).filename(), "arena.yaml");
}

TEST_F(PackageFiles, WhatIsNowhereIsSaidWithBothPlaces) {
  const auto message = messageOf<InputError>([] { scenarioFile("no_such_scenario"); });
  EXPECT_NE(message.find("neither here nor in"), std::string::npos) << message;
}

}  // namespace
}  // namespace stereo_nav::ros_io
