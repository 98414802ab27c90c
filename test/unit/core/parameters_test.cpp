#include "stereo_nav/core/parameters.h"

#include <gtest/gtest.h>

#include <limits>

namespace stereo_nav {
namespace {

enum class Method { kDistance, kPerAxis };

struct Inner {
  int threshold = 20;
  void describe(ParameterVisitor& visitor) {
    visitor.integer("threshold", threshold, {1, 255}, "grey levels", "FAST threshold");
  }
};

struct Outer {
  Inner corners;
  double max_depth_m = 10.0;
  bool enabled = true;
  Method method = Method::kDistance;
  std::string frame = "odom";
  void describe(ParameterVisitor& visitor) {
    visitSection(visitor, "corners", corners);
    visitor.real("max_depth_m", max_depth_m, {0.1, 100.0}, "m", "farthest point used");
    visitor.flag("enabled", enabled, "whether it runs");
    visitEnum(visitor, "method", method, {{"distance", Method::kDistance}, {"per_axis", Method::kPerAxis}},
              "test");
    visitor.text("frame", frame, "name of a frame", Change::kLive);
  }
};

std::string yamlError(const std::string& yaml) {
  Outer params;
  try {
    readParameters(YAML::Load(yaml), "test.yaml", params);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

TEST(Parameters, ReadsNestedValuesAndKeepsDefaultsOfTheRest) {
  Outer params;
  readParameters(YAML::Load("{corners: {threshold: 7}, method: per_axis, enabled: false, frame: map}"),
                 "test.yaml", params);
  EXPECT_EQ(params.corners.threshold, 7);
  EXPECT_EQ(params.method, Method::kPerAxis);
  EXPECT_FALSE(params.enabled);
  EXPECT_EQ(params.frame, "map");
  EXPECT_EQ(params.max_depth_m, 10.0);
}

TEST(Parameters, AnEmptyFileMeansDefaults) {
  Outer params;
  readParameters(YAML::Load(""), "test.yaml", params);
  EXPECT_EQ(params.corners.threshold, 20);
}

TEST(Parameters, MessagesNameParameterValueAndRange) {
  EXPECT_EQ(yamlError("{corners: {threshold: 300}}"),
            "test.yaml: corners.threshold is 300, allowed is 1 to 255 grey levels (FAST threshold)");
  EXPECT_EQ(yamlError("{corners: {treshold: 3}}"),
            "test.yaml: unknown parameter corners.treshold; known here: threshold");
  EXPECT_EQ(yamlError("{method: best}"),
            "test.yaml: method is 'best', allowed is one of: distance | per_axis");
  EXPECT_EQ(yamlError("{max_depth_m: far}"), "test.yaml: max_depth_m is 'far', must be a number");
  EXPECT_EQ(yamlError("{corners: 3}"), "test.yaml: corners. must be a list of `name: value` lines");
  EXPECT_NE(yamlError("{max_depth_m: .nan}"), "");
}

TEST(Parameters, ValuesSetInCodeAreChecked) {
  Outer params;
  params.max_depth_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(validateParameters(params, "code"), ParameterError);
  params.max_depth_m = 1.0;
  EXPECT_NO_THROW(validateParameters(params, "code"));
}

TEST(Parameters, DocumentationListsEveryFieldWithItsDefault) {
  const auto docs = documentParameters(Outer());
  ASSERT_EQ(docs.size(), 5u);
  EXPECT_EQ(docs[0].name, "corners.threshold");
  EXPECT_EQ(docs[0].default_value, "20");
  EXPECT_EQ(docs[0].range, "1 to 255");
  EXPECT_EQ(docs[3].default_value, "distance");
  EXPECT_EQ(docs[4].type, "string");
  EXPECT_FALSE(docs[0].live);
  EXPECT_TRUE(docs[4].live);
}

}  // namespace
}  // namespace stereo_nav
