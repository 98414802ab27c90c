#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "core/planar_motion.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::mapping {

/// What the graph's code needs to know of SE(2) and SE(3). Tangent vectors are (translation m, rotation rad).
template <class Pose>
struct Motion;

template <>
struct Motion<Eigen::Isometry2d> {
  static constexpr int kDof = 3;
  using Vector = Eigen::Vector3d;
  using Matrix = Eigen::Matrix3d;
  static Eigen::Isometry2d exp(const Vector& twist) { return expPlanar(twist); }
  static Vector log(const Eigen::Isometry2d& T) { return logPlanar(T); }
  static Matrix adjoint(const Eigen::Isometry2d& T) { return adjointPlanar(T); }
};

template <>
struct Motion<Eigen::Isometry3d> {
  static constexpr int kDof = 6;
  using Vector = Vector6d;
  using Matrix = Matrix6d;
  static Eigen::Isometry3d exp(const Vector& twist) { return expMotion(twist); }
  static Vector log(const Eigen::Isometry3d& T) { return logMotion(T); }
  static Matrix adjoint(const Eigen::Isometry3d& T) { return stereo_nav::adjoint(T); }
};

/// A measured motion between two vertices.
template <class Pose>
struct GraphEdge {
  std::size_t from = 0, to = 0;  ///< indices of vertices
  Pose T_from_to = Pose::Identity();
  /// Inverse covariance of edgeError(); g2o's convention: in space the last three are the vector part of the
  /// quaternion, half an angle.
  typename Motion<Pose>::Matrix information = Motion<Pose>::Matrix::Identity();
};

/// Poses and measured motions between them; a pose takes coordinates of its vertex into the map. Vertices are
/// ordered by their ids, so that consecutive ones follow each other in time.
template <class Pose>
struct PoseGraph {
  std::vector<long long> ids;  ///< in increasing order, one a vertex
  std::vector<Pose> poses;
  std::vector<GraphEdge<Pose>> edges;
};

using PlanarGraph = PoseGraph<Eigen::Isometry2d>;
using SpatialGraph = PoseGraph<Eigen::Isometry3d>;

/// For each edge whether it is a loop: all but the first between each two consecutive vertices.
template <class Pose>
std::vector<bool> loopsOf(const PoseGraph<Pose>& graph);

/// Index of the first edge between each vertex and the next one; graph.edges.size() where there is none.
template <class Pose>
std::vector<std::size_t> odometryOf(const PoseGraph<Pose>& graph);

/// Poses by following edges from the first vertex of each connected part, along the odometry where there is
/// one: the start where there is no other. The first vertex of a part keeps its pose.
template <class Pose>
void chainPoses(PoseGraph<Pose>& graph);

/// For each vertex whether it holds its part of the graph in place: the first one of each connected part.
/// Edges of weight 0 connect nothing; without weights all count.
template <class Pose>
std::vector<bool> anchorsOf(const PoseGraph<Pose>& graph, const std::vector<double>& weights = {});

}  // namespace stereo_nav::mapping
