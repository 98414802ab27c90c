#pragma once

#include <cstdlib>
#include <random>
#include <string>

#include "core/angles.h"
#include "mapping/map/g2o_file.h"

namespace stereo_nav::mapping {

/// A drive of three laps on a circle of 5 m, 36 vertices a lap: odometry between consecutive ones and a loop
/// from each to the one a lap before, all with noise of the standard deviations that their informations say.
/// `truth` has the poses without noise; those of `graph` are by dead reckoning.
struct Laps {
  PlanarGraph graph, truth;
};

inline Laps drivenLaps(unsigned seed) {
  constexpr int kLaps = 3, kPerLap = 36;
  constexpr double kStep_rad = 2.0 * kPi / kPerLap;
  const Eigen::Vector3d sigma(0.02, 0.02, 0.005);
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  Laps laps;
  for (int v = 0; v < kLaps * kPerLap; ++v) {
    laps.graph.ids.push_back(v);
    const Eigen::Isometry2d turn(Eigen::Rotation2Dd(v * kStep_rad));
    laps.graph.poses.push_back(Eigen::Translation2d(-5.0, 0.0) * turn * Eigen::Translation2d(5.0, 0.0) *
                               Eigen::Rotation2Dd(0.5 * kPi));
  }
  laps.truth = laps.graph;
  const auto join = [&](int from, int to) {
    GraphEdge<Eigen::Isometry2d> edge;
    edge.from = static_cast<std::size_t>(from);
    edge.to = static_cast<std::size_t>(to);
    const Eigen::Vector3d noise(normal(generator), normal(generator), normal(generator));
    edge.T_from_to = laps.truth.poses[edge.from].inverse() * laps.truth.poses[edge.to] *
                     expPlanar(sigma.cwiseProduct(noise));
    edge.information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
    laps.graph.edges.push_back(edge);
  };
  for (int v = 0; v + 1 < kLaps * kPerLap; ++v) join(v, v + 1);
  for (int v = kPerLap; v < kLaps * kPerLap; ++v) join(v - kPerLap, v);
  chainPoses(laps.graph);
  return laps;
}

/// RMS distance of positions in m; both graphs hold their first vertex at the same place.
template <class Pose>
double rmsDistance(const PoseGraph<Pose>& a, const PoseGraph<Pose>& b) {
  double sum = 0.0;
  for (std::size_t v = 0; v < a.poses.size(); ++v)
    sum += (a.poses[v].translation() - b.poses[v].translation()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.poses.size()));
}

/// The folder of public pose graphs, empty where there is none.
inline std::string graphFolder() {
  const char* data = std::getenv("STEREO_NAV_DATA");
  return data == nullptr ? std::string() : std::string(data) + "/g2o/";
}

}  // namespace stereo_nav::mapping
