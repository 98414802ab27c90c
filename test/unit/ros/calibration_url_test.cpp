#include "ros/calibration_url.h"

#include <gtest/gtest.h>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav {
namespace {

TEST(CalibrationUrl, BecomesAPath) {
  EXPECT_EQ(ros_io::pathOfUrl("file:///etc/left.yaml"), "/etc/left.yaml");
  EXPECT_EQ(ros_io::pathOfUrl("/etc/left.yaml"), "/etc/left.yaml");
  EXPECT_THROW(ros_io::pathOfUrl("http://example.org/left.yaml"), ParameterError);
  EXPECT_THROW(ros_io::pathOfUrl("package://no_such_package_here/left.yaml"), ParameterError);
}

}  // namespace
}  // namespace stereo_nav
