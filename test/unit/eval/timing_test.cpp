#include "stereo_nav/eval/timing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stereo_nav::eval {
namespace {

TEST(Timing, mediansPerStageInOrderOfAppearance) {
  std::vector<FrameTiming> frames(3);
  frames[0] = {10.0, 30.0, {{"corners", 2.0}}};
  frames[1] = {20.0, 32.0, {{"tracking", 5.0}, {"corners", 4.0}}};
  frames[2] = {40.0, 31.0, {{"tracking", 7.0}, {"corners", 3.0}}};
  const auto summary = summariseTiming(frames);
  EXPECT_DOUBLE_EQ(summary.median_ms, 20.0);
  EXPECT_DOUBLE_EQ(summary.p95_ms, 38.0);
  EXPECT_DOUBLE_EQ(summary.max_ms, 40.0);
  EXPECT_DOUBLE_EQ(summary.disparity_median_ms, 31.0);
  EXPECT_EQ(toJson(summary),
            "{\n"
            "  \"frame_time_ms\": {\n"
            "    \"median\": 20.0,\n"
            "    \"p95\": 38.0,\n"
            "    \"p99\": 39.6,\n"
            "    \"max\": 40.0\n"
            "  },\n"
            "  \"stage_time_ms\": {\n"
            "    \"corners\": 3.0,\n"
            "    \"tracking\": 6.0\n"
            "  },\n"
            "  \"disparity_time_ms\": 31.0\n"
            "}\n");
}

TEST(Timing, noDisparityIsNull) {
  const auto json = toJson(summariseTiming({FrameTiming{}}));
  EXPECT_NE(json.find("\"disparity_time_ms\": null"), std::string::npos);
  EXPECT_NE(json.find("\"stage_time_ms\": {}"), std::string::npos);
  EXPECT_TRUE(std::isnan(summariseTiming({}).median_ms));
}

}  // namespace
}  // namespace stereo_nav::eval
