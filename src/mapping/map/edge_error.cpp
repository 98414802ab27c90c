#include "mapping/map/edge_error.h"

#include "core/angles.h"

namespace stereo_nav::mapping {
namespace {

using Plane = Eigen::Isometry2d;
using Space = Eigen::Isometry3d;

/// The rotation of D with w >= 0.
Eigen::Quaterniond turnOf(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  return q;
}

}  // namespace

template <>
Eigen::Vector3d edgeError(const GraphEdge<Plane>& edge, const Plane& T_map_from, const Plane& T_map_to) {
  const Eigen::Matrix2d R_z = edge.T_from_to.linear();
  const Eigen::Vector2d p_from =
      T_map_from.linear().transpose() * (T_map_to.translation() - T_map_from.translation());
  Eigen::Vector3d error;
  error << R_z.transpose() * (p_from - edge.T_from_to.translation()),
      wrapRadians(yawOf(T_map_to) - yawOf(T_map_from) - yawOf(edge.T_from_to));
  return error;
}

template <>
EdgeJacobians<Plane> edgeJacobians(const GraphEdge<Plane>& edge, const Plane& T_map_from,
                                   const Plane& T_map_to) {
  const Eigen::Matrix2d R_z = edge.T_from_to.linear(), R_map_from = T_map_from.linear();
  const Eigen::Vector2d p_from = R_map_from.transpose() * (T_map_to.translation() - T_map_from.translation());
  EdgeJacobians<Plane> J;
  J.to.setIdentity();
  J.to.topLeftCorner<2, 2>() = (R_map_from * R_z).transpose();
  J.from = -J.to;
  // d (R^T p) / d angle = -[1]x R^T p
  J.from.topRightCorner<2, 1>() = R_z.transpose() * Eigen::Vector2d(p_from.y(), -p_from.x());
  return J;
}

template <>
Vector6d edgeError(const GraphEdge<Space>& edge, const Space& T_map_from, const Space& T_map_to) {
  const Eigen::Matrix3d R_z = edge.T_from_to.linear(), R_map_from = T_map_from.linear();
  const Eigen::Vector3d p_from = R_map_from.transpose() * (T_map_to.translation() - T_map_from.translation());
  Vector6d error;
  error << R_z.transpose() * (p_from - edge.T_from_to.translation()),
      turnOf((R_map_from * R_z).transpose() * T_map_to.linear()).vec();
  return error;
}

template <>
EdgeJacobians<Space> edgeJacobians(const GraphEdge<Space>& edge, const Space& T_map_from,
                                   const Space& T_map_to) {
  const Eigen::Matrix3d R_z = edge.T_from_to.linear(), R_map_from = T_map_from.linear();
  const Eigen::Vector3d p_from = R_map_from.transpose() * (T_map_to.translation() - T_map_from.translation());
  const Eigen::Matrix3d R_d_map = (R_map_from * R_z).transpose();
  const Eigen::Quaterniond q = turnOf(R_d_map * T_map_to.linear());
  EdgeJacobians<Space> J;
  J.to.setZero();
  J.to.topLeftCorner<3, 3>() = R_d_map;
  J.from = -J.to;
  J.from.topRightCorner<3, 3>() = R_z.transpose() * hat(p_from);
  // q (1, dr/2) and (1, -R_z^T dr/2) q, vector parts.
  const Eigen::Matrix3d w = q.w() * Eigen::Matrix3d::Identity();
  J.to.bottomRightCorner<3, 3>() = 0.5 * (w + hat(q.vec()));
  J.from.bottomRightCorner<3, 3>() = -0.5 * (w - hat(q.vec())) * R_z.transpose();
  return J;
}

template <class Pose>
double chiSquare(const PoseGraph<Pose>& graph, const GraphEdge<Pose>& edge) {
  const auto error = edgeError(edge, graph.poses[edge.from], graph.poses[edge.to]);
  return error.dot(edge.information * error);
}

template <class Pose>
double chiSquare(const PoseGraph<Pose>& graph, const std::vector<double>& weights) {
  double sum = 0.0;
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    sum += (weights.empty() ? 1.0 : weights[e]) * chiSquare(graph, graph.edges[e]);
  return sum;
}

template double chiSquare(const PlanarGraph&, const GraphEdge<Plane>&);
template double chiSquare(const SpatialGraph&, const GraphEdge<Space>&);
template double chiSquare(const PlanarGraph&, const std::vector<double>&);
template double chiSquare(const SpatialGraph&, const std::vector<double>&);

}  // namespace stereo_nav::mapping
