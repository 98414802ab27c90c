#include "mapping/map/g2o_file.h"

#include "mapping/map/edge_error.h"
#include "stereo_nav/core/input_error.h"
#include "support/trajectories.h"

namespace stereo_nav::mapping {
namespace {

class G2oFile : public ::testing::Test {
 protected:
  AnyGraph read(const std::string& text) const { return readG2o(folder_.write("graph.g2o", text)); }
  void expectError(const std::string& text, const std::string& part) const {
    const std::string error = messageOf<InputError>([&] { read(text); });
    EXPECT_NE(error.find(part), std::string::npos) << text << "\n" << error;
  }
  TemporaryFolder folder_;
};

TEST_F(G2oFile, ReadsPosesOfAPlaneInAnyOrder) {
  const auto graph = std::get<PlanarGraph>(read(
      "# a comment\nVERTEX_SE2 7 1 2 0.5\nEDGE_SE2 3 7 1 0 0.1 1 2 3 14 5 60\nVERTEX_SE2 3 0 0 0\nFIX 3\n"));
  EXPECT_EQ(graph.ids, (std::vector<long long>{3, 7}));
  EXPECT_NEAR(yawOf(graph.poses[1]), 0.5, 1e-15);
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.edges[0].from, 0U);
  Eigen::Matrix3d information;
  information << 1, 2, 3, 2, 14, 5, 3, 5, 60;
  EXPECT_EQ(graph.edges[0].information, information);
}

TEST_F(G2oFile, ReadsWhatItWritesInSpace) {
  SpatialGraph graph;
  graph.ids = {0, 1};
  graph.poses = {Eigen::Isometry3d::Identity(),
                 Eigen::Translation3d(1, 2, 3) * Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)};
  GraphEdge<Eigen::Isometry3d> edge;
  edge.to = 1;
  edge.T_from_to = graph.poses[1] * Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX());
  edge.information.diagonal() << 1, 2, 3, 4, 5, 6;
  edge.information(0, 5) = edge.information(5, 0) = 0.25;
  graph.edges = {edge};
  const auto again = std::get<SpatialGraph>(read(toG2o(graph)));
  EXPECT_TRUE(again.poses[1].isApprox(graph.poses[1], 1e-15));
  EXPECT_EQ(again.edges[0].information, edge.information);
  EXPECT_NEAR(chiSquare(again), chiSquare(graph), 1e-12);
}

TEST_F(G2oFile, ChainsPosesWhereTheFileHasNone) {
  const auto graph = std::get<PlanarGraph>(read(
      "EDGE_SE2 0 1 1 0 1.5707963267948966 1 0 0 1 0 1\nEDGE_SE2 0 2 5 5 0 1 0 0 1 0 1\nEDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\n"));
  EXPECT_TRUE(graph.poses[2].translation().isApprox(Eigen::Vector2d(1, 1), 1e-12));
  EXPECT_EQ(loopsOf(graph), (std::vector<bool>{false, true, false}));
}

TEST_F(G2oFile, NamesTheLineOfWhatItCannotUse) {
  const std::string vertices = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\n",
                    edge = "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n";
  expectError("", "no edges");
  expectError(vertices + "EDGE_SE2 0 1 1 0 0 1 0 0 1 0\n", ":3: EDGE_SE2 has 11 columns, 12 are needed");
  expectError(vertices + edge + "VERTEX_SE2 1 1 0 0\n", ":4: vertex 1 comes twice");
  expectError(vertices + "EDGE_SE2 0 2 1 0 0 1 0 0 1 0 1\n", ":3: no vertex 2");
  expectError(vertices + "EDGE_SE2 1 1 1 0 0 1 0 0 1 0 1\n", ":3: an edge from vertex 1 to itself");
  expectError(vertices + "EDGE_SE2 0 1 1 0 0 1 0 0 -1 0 1\n", ":3: the information is not positive definite");
  expectError(vertices + "EDGE_SE2 0 1 1 0 x 1 0 0 1 0 1\n", ":3: 'x' is not a finite number");
  expectError(vertices + "VERTEX_SE3:QUAT 2 0 0 0 0 0 0 1\n", ":1: 'VERTEX_SE2' cannot be used beside");
  expectError("VERTEX_SE3:QUAT 2 0 0 0 0 0 0 0\n", ":1: the quaternion has the length 0");
  expectError(vertices + edge + "VERTEX_XY 5 1 1\n", ":4: 'VERTEX_XY' cannot be used");
}

}  // namespace
}  // namespace stereo_nav::mapping
