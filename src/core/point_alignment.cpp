#include "core/point_alignment.h"

#include <cmath>
#include <stdexcept>

namespace stereo_nav {
namespace {

Eigen::Matrix3Xd columns(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xd matrix(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) matrix.col(static_cast<Eigen::Index>(i)) = points[i];
  return matrix;
}

void requirePairs(const std::vector<Eigen::Vector3d>& source, const std::vector<Eigen::Vector3d>& target) {
  if (source.empty() || source.size() != target.size())
    throw std::invalid_argument("an alignment of points needs two lists of equal, nonzero length");
}

}  // namespace

Eigen::Isometry3d alignRigidly(const std::vector<Eigen::Vector3d>& source,
                               const std::vector<Eigen::Vector3d>& target) {
  requirePairs(source, target);
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  T_target_source.matrix() = Eigen::umeyama(columns(source), columns(target), false);
  return T_target_source;
}

Similarity alignSimilarly(const std::vector<Eigen::Vector3d>& source,
                          const std::vector<Eigen::Vector3d>& target, const SimilarityFreedom& freedom) {
  requirePairs(source, target);
  Eigen::Matrix3Xd p = columns(source), q = columns(target);
  const Eigen::Vector3d p_mean = p.rowwise().mean(), q_mean = q.rowwise().mean();
  p.colwise() -= p_mean;
  q.colwise() -= q_mean;
  Similarity similarity;
  if (freedom.planar) {
    const Eigen::Matrix3d sum = q * p.transpose();
    const double angle_rad = std::atan2(sum(1, 0) - sum(0, 1), sum(0, 0) + sum(1, 1));
    similarity.R_target_source = Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  } else {
    similarity.R_target_source = Eigen::umeyama(p, q, false).topLeftCorner<3, 3>();
  }
  if (freedom.scale)
    similarity.scale = (similarity.R_target_source * p).cwiseProduct(q).sum() / p.squaredNorm();
  similarity.t_target_m = q_mean - similarity.scale * (similarity.R_target_source * p_mean);
  return similarity;
}

}  // namespace stereo_nav
