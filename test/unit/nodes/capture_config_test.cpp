// What dynamic_reconfigure offers on the running capture node is what the node's parameters allow.
#include <gtest/gtest.h>

#include <boost/any.hpp>
#include <map>

#include "stereo_nav/StereoCaptureConfig.h"
#include "stereo_nav/capture/capture_params.h"
#include "stereo_nav/params/parameters.h"

namespace stereo_nav::capture {
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
  void flag(const std::string&, bool&, const std::string&) override {}
  void text(const std::string&, std::string&, const std::string&) override {}
  void choice(const std::string&, std::size_t&, const std::vector<std::string>&,
              const std::string&) override {}
  void enterSection(const std::string&) override {}
  void leaveSection() override {}

  std::map<std::string, Number> numbers;
};

double numberOf(const StereoCaptureConfig::AbstractParamDescription& field,
                const StereoCaptureConfig& config) {
  boost::any value;
  field.getValue(config, value);
  return field.type == "int" ? static_cast<double>(boost::any_cast<int>(value))
                             : boost::any_cast<double>(value);
}

TEST(StereoCaptureConfig, AgreesWithTheParameters) {
  NumberCollector collector;
  CaptureParams().describe(collector);
  const auto& fields = StereoCaptureConfig::__getParamDescriptions__();
  EXPECT_EQ(fields.size(), 3u) << "exposure, gain, max_skew";
  for (const auto& field : fields) {
    SCOPED_TRACE(field->name);
    ASSERT_EQ(collector.numbers.count(field->name), 1u) << "no parameter of this name";
    const Number& number = collector.numbers.at(field->name);
    EXPECT_EQ(field->type, number.type);
    EXPECT_EQ(numberOf(*field, StereoCaptureConfig::__getDefault__()), number.value);
    EXPECT_EQ(numberOf(*field, StereoCaptureConfig::__getMin__()), number.min);
    EXPECT_EQ(numberOf(*field, StereoCaptureConfig::__getMax__()), number.max);
  }
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
}  // namespace stereo_nav::capture
