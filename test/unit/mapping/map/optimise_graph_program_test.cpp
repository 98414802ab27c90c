// `optimise_graph` as its users run it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "stereo_nav/core/trajectory.h"
#include "support/command.h"
#include "support/trajectories.h"
#include "unit/mapping/map/graph_scene.h"

namespace stereo_nav::mapping {
namespace {

class OptimiseGraphProgram : public ::testing::Test {
 protected:
  OptimiseGraphProgram() { folder_.write("graph.g2o", toG2o(drivenLaps(1).graph)); }
  test::CommandResult optimiseGraph(const std::string& arguments) const {
    return test::runCommand(std::string(OPTIMISE_GRAPH) + " " + arguments);
  }
  nlohmann::json summary(const std::string& name) const {
    return nlohmann::json::parse(folder_.read(name + "/summary.json"));
  }

  TemporaryFolder folder_;
};

TEST_F(OptimiseGraphProgram, WritesGraphTrajectoryFiguresAndPicture) {
  const auto result = optimiseGraph((folder_ / "graph.g2o") + " --output " + (folder_ / "optimised"));
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("108 vertices, 179 edges, of which 72 are loops"), std::string::npos)
      << result.output;
  const auto json = summary("optimised");
  EXPECT_LT(json["chi_square_after"], 300.0);
  EXPECT_GT(json["chi_square_before"], json["chi_square_after"]);
  EXPECT_EQ(readTum(folder_ / "optimised/trajectory.tum").size(), 108U);
  EXPECT_NE(folder_.read("optimised/graph.svg").find("</svg>"), std::string::npos);

  const auto again = optimiseGraph((folder_ / "optimised/graph.g2o") + " --output " + (folder_ / "again"));
  ASSERT_EQ(again.status, 0) << again.output;
  EXPECT_NEAR(summary("again")["chi_square_before"], json["chi_square_after"], 1e-6);
}

TEST_F(OptimiseGraphProgram, ListsWhatBecameOfFalseLoops) {
  const auto result = optimiseGraph((folder_ / "graph.g2o") +
                                    " --robust --false-loops 10 --seed 1 --output " + (folder_ / "spoilt"));
  ASSERT_EQ(result.status, 0) << result.output;
  const auto json = summary("spoilt");
  EXPECT_EQ(json["false_loops_added"], 7);
  EXPECT_EQ(json["false_loops_kept"], 0);
  EXPECT_LT(json["rms_from_clean_optimum_m"], 0.05);
  const std::string loops = folder_.read("spoilt/loops.csv");
  EXPECT_EQ(std::count(loops.begin(), loops.end(), '\n'), 1 + 72 + 7);
  EXPECT_NE(loops.find("against the map"), std::string::npos);
}

TEST_F(OptimiseGraphProgram, SaysInOneLineWhatItCannotUse) {
  for (const char* arguments : {"", "/nowhere.g2o", "--false-loops x graph.g2o"}) {
    const auto result = optimiseGraph(arguments);
    EXPECT_EQ(result.status, 2) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
  }
}

}  // namespace
}  // namespace stereo_nav::mapping
