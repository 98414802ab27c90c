#include <gtest/gtest.h>

#include "sensors/camera/capture_params.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::camera {
namespace {

TEST(CaptureParams, AreThoseOfTheConfigurationFile) {
  YAML::Node file = loadYamlFile(std::string(STEREO_NAV_SOURCE_DIR) + "/config/capture.yaml");
  const YAML::Node controls = file["controls"];
  EXPECT_EQ(controls["power_line_frequency"].as<int>(), 1) << "the thesis' controls";
  EXPECT_EQ(controls["exposure_auto"].as<int>(), 3);
  EXPECT_EQ(controls["exposure_auto_priority"].as<int>(), 0);
  EXPECT_EQ(controls["backlight_compensation"].as<int>(), 1);
  file.remove("controls");
  CaptureParams params;
  readParameters(file, "config/capture.yaml", params);
  EXPECT_EQ(params.width, 640);
}

}  // namespace
}  // namespace stereo_nav::camera
