// What dynamic_reconfigure offers on the running nodes is what their parameters allow.
#include <gtest/gtest.h>

#include <boost/any.hpp>
#include <map>

#include "nodes/imu_bridge/imu_bridge_node.h"
#include "nodes/visual_odometry/visual_odometry_params.h"
#include "sensors/camera/capture_params.h"
#include "stereo_nav/ImuBridgeConfig.h"
#include "stereo_nav/StereoCaptureConfig.h"
#include "stereo_nav/UncertaintyConfig.h"
#include "stereo_nav/VisualOdometryConfig.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::camera {
namespace {

struct Number {
  std::string type;
  double value, min, max;
};

/// The numbers among the parameters.
class NumberCollector : public ParameterVisitor {
 public:
  void integer(const std::string& name, int& value, Range<int> range, const std::string&,
               const std::string&) override {
    numbers[name] = {"int", static_cast<double>(value), static_cast<double>(range.min),
                     static_cast<double>(range.max)};
  }
  void real(const std::string& name, double& value, Range<double> range, const std::string&,
            const std::string&) override {
    numbers[name] = {"double", value, range.min, range.max};
  }
  void flag(const std::string& name, bool& value, const std::string&) override {
    numbers[name] = {"bool", static_cast<double>(value), 0.0, 1.0};
  }
  void text(const std::string&, std::string&, const std::string&) override {}
  void choice(const std::string&, std::size_t&, const std::vector<std::string>&,
              const std::string&) override {}
  void enterSection(const std::string&) override {}
  void leaveSection() override {}

  std::map<std::string, Number> numbers;
};

template <class Config>
double numberOf(const typename Config::AbstractParamDescription& field, const Config& config) {
  boost::any value;
  field.getValue(config, value);
  if (field.type == "bool") return static_cast<double>(boost::any_cast<bool>(value));
  if (field.type == "int") return static_cast<double>(boost::any_cast<int>(value));
  return boost::any_cast<double>(value);
}

/// Names, types, defaults and ranges of what dynamic_reconfigure offers are those of the node's parameters.
template <class Config, class Params>
void expectAgreement(std::size_t count) {
  NumberCollector collector;
  Params().describe(collector);
  const auto& fields = Config::__getParamDescriptions__();
  EXPECT_EQ(fields.size(), count);
  for (const auto& field : fields) {
    SCOPED_TRACE(field->name);
    ASSERT_EQ(collector.numbers.count(field->name), 1u) << "no parameter of this name";
    const Number& number = collector.numbers.at(field->name);
    EXPECT_EQ(field->type, number.type);
    EXPECT_EQ(numberOf<Config>(*field, Config::__getDefault__()), number.value);
    EXPECT_EQ(numberOf<Config>(*field, Config::__getMin__()), number.min);
    EXPECT_EQ(numberOf<Config>(*field, Config::__getMax__()), number.max);
  }
}

TEST(Reconfigure, StereoCaptureAgreesWithTheParameters) {
  expectAgreement<StereoCaptureConfig, CaptureParams>(3);
}

TEST(Reconfigure, ImuBridgeAgreesWithTheParameters) {
  expectAgreement<ImuBridgeConfig, ros_io::ImuBridgeParams>(4);
}

TEST(Reconfigure, VisualOdometryAgreesWithTheParameters) {
  expectAgreement<VisualOdometryConfig, nodes::VisualOdometryParams>(3);
  expectAgreement<UncertaintyConfig, estimation::UncertaintyParams>(4);
}

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
