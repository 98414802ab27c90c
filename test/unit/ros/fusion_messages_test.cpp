#include "ros/fusion_messages.h"

#include <gtest/gtest.h>

#include <limits>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::ros_io::test {
namespace {

/// Messages of a filter with GNSS, whose antenna sits at `antenna`.
class FusionMessagesTest : public testing::Test {
 protected:
  static estimation::FusionConfig config() {
    return estimation::readFusionConfig(
        YAML::Load(
            "fix0: fix\nfix0_config: [true, true, true, false, false, false, false, false, false, false, "
            "false, false, false, false, false]\n"),
        "test.yaml");
  }

  /// x, y, z of a fix; nothing where it gives no measurement.
  std::optional<Eigen::Vector3d> place(const sensor_msgs::NavSatFix& fix) {
    const auto measurements = messages_.convert(0, fix);
    if (measurements.empty()) return std::nullopt;
    EXPECT_EQ(measurements[0].kind, estimation::Measurement::Kind::kPose);
    EXPECT_NEAR(measurements[0].covariance(1, 1), 0.04, 1e-12);
    return measurements[0].pose.translation();
  }

  static sensor_msgs::NavSatFix fixAt(double latitude, double longitude, double altitude) {
    sensor_msgs::NavSatFix fix;
    fix.header.frame_id = "base_link";
    fix.latitude = latitude;
    fix.longitude = longitude;
    fix.altitude = altitude;
    for (std::size_t i = 0; i < 3; ++i) fix.position_covariance[4 * i] = 0.04;
    return fix;
  }

  const estimation::FusionConfig config_ = config();
  FusionMessages messages_{config_, estimation::setUp(config_),
                           [](const std::string&) { return std::optional<Eigen::Isometry3d>(); }};
};

TEST_F(FusionMessagesTest, AFixIsEastAndNorthOfTheFirstOne) {
  EXPECT_EQ(place(fixAt(45.0, 11.0, 50.0)).value().norm(), 0.0);
  // Lengths of a thousandth of a degree at 45 degrees on WGS 84, by its tables; 50 m up they are 1e-5 longer.
  const Eigen::Vector3d p = place(fixAt(45.001, 11.001, 53.0)).value();
  EXPECT_NEAR(p.x(), 78.847, 0.002);
  EXPECT_NEAR(p.y(), 111.132, 0.002);
  EXPECT_NEAR(p.z(), 3.0, 1e-9);
}

TEST_F(FusionMessagesTest, AFixMayCrossTheDateLine) {
  place(fixAt(0.0, 179.9999, 0.0));
  EXPECT_NEAR(place(fixAt(0.0, -179.9999, 0.0)).value().x(), 22.264, 0.001);
}

TEST_F(FusionMessagesTest, WithoutAFixThereIsNoMeasurement) {
  sensor_msgs::NavSatFix none = fixAt(45.0, 11.0, 50.0);
  none.status.status = sensor_msgs::NavSatStatus::STATUS_NO_FIX;
  EXPECT_FALSE(place(none));
  EXPECT_FALSE(place(fixAt(std::numeric_limits<double>::quiet_NaN(), 11.0, 50.0)));
  EXPECT_EQ(place(fixAt(46.0, 11.0, 50.0)).value().norm(), 0.0) << "the first fix that is one is the origin";
}

}  // namespace
}  // namespace stereo_nav::ros_io::test
