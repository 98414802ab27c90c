#include "mapping/map/chordal_start.h"

#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

namespace stereo_nav::mapping {
namespace {

template <class Pose>
constexpr int kAxes = Pose::Dim;
template <class Pose>
using Square = Eigen::Matrix<double, kAxes<Pose>, kAxes<Pose>>;

/// Least squares for blocks X_v of `rows` rows each, one block a vertex, those of anchors being known: the
/// sum over edges of weight |X_to - A X_from - b|^2. Assembled edge by edge.
class BlockSystem {
 public:
  BlockSystem(const std::vector<bool>& anchors, Eigen::MatrixXd values, int rows)
      : rows_(rows), values_(std::move(values)), place_(anchors.size(), -1) {
    for (std::size_t v = 0; v < anchors.size(); ++v)
      if (!anchors[v]) place_[v] = rows_ * unknown_++;
    right_ = Eigen::MatrixXd::Zero(rows_ * unknown_, values_.cols());
  }

  void add(std::size_t from, std::size_t to, double weight, const Eigen::MatrixXd& A,
           const Eigen::MatrixXd& b) {
    const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(rows_, rows_);
    addPart(to, to, weight * I);
    addPart(from, from, weight * A.transpose() * A);
    addPart(to, from, -weight * A);
    addPart(from, to, -weight * A.transpose());
    if (place_[to] >= 0) right_.middleRows(place_[to], rows_) += weight * b;
    if (place_[from] >= 0) right_.middleRows(place_[from], rows_) -= weight * A.transpose() * b;
  }

  /// All blocks, one below the other; the given ones where the system cannot be solved.
  const Eigen::MatrixXd& solve() {
    if (unknown_ == 0) return values_;
    Eigen::SparseMatrix<double> normal(rows_ * unknown_, rows_ * unknown_);
    normal.setFromTriplets(parts_.begin(), parts_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(normal);
    if (factors.info() != Eigen::Success) return values_;
    const Eigen::MatrixXd solution = factors.solve(right_);
    for (std::size_t v = 0; v < place_.size(); ++v)
      if (place_[v] >= 0) block(v) = solution.middleRows(place_[v], rows_);
    return values_;
  }

 private:
  Eigen::Block<Eigen::MatrixXd> block(std::size_t v) {
    return values_.block(static_cast<Eigen::Index>(v) * rows_, 0, rows_, values_.cols());
  }
  /// Only the lower triangle is kept; what stands beside a known block goes to the right.
  void addPart(std::size_t row, std::size_t column, const Eigen::MatrixXd& part) {
    if (place_[row] < 0) return;
    if (place_[column] < 0) {
      right_.middleRows(place_[row], rows_) -= part * block(column);
      return;
    }
    if (place_[row] < place_[column]) return;
    for (int r = 0; r < rows_; ++r)
      for (int c = 0; c < rows_; ++c) parts_.emplace_back(place_[row] + r, place_[column] + c, part(r, c));
  }

  int rows_, unknown_ = 0;
  Eigen::MatrixXd values_, right_;
  std::vector<int> place_;
  std::vector<Eigen::Triplet<double>> parts_;
};

template <class Pose>
Square<Pose> nearestRotation(const Square<Pose>& matrix) {
  const Eigen::JacobiSVD<Square<Pose>> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Square<Pose> U = svd.matrixU();
  if (U.determinant() * svd.matrixV().determinant() < 0.0) U.col(kAxes<Pose> - 1) *= -1.0;
  return U * svd.matrixV().transpose();
}

/// Blocks are transposed rotations: R_to^T = R_from_to^T R_from^T.
template <class Pose>
void startRotations(const PoseGraph<Pose>& graph, const std::vector<double>& weights,
                    const std::vector<bool>& anchors, std::vector<Pose>& poses) {
  constexpr int kRows = kAxes<Pose>, kTurns = Motion<Pose>::kDof - kRows;
  Eigen::MatrixXd values(kRows * static_cast<Eigen::Index>(poses.size()), kRows);
  for (std::size_t v = 0; v < poses.size(); ++v)
    values.middleRows(static_cast<Eigen::Index>(v) * kRows, kRows) = poses[v].linear().transpose();
  BlockSystem system(anchors, values, kRows);
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(kRows, kRows);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const auto& edge = graph.edges[e];
    const double weight = (weights.empty() ? 1.0 : weights[e]) *
                          edge.information.template bottomRightCorner<kTurns, kTurns>().trace() / kTurns;
    if (weight > 0.0) system.add(edge.from, edge.to, weight, edge.T_from_to.linear().transpose(), zero);
  }
  const Eigen::MatrixXd& solved = system.solve();
  for (std::size_t v = 0; v < poses.size(); ++v) {
    if (anchors[v]) continue;
    const Square<Pose> relaxed = solved.middleRows(static_cast<Eigen::Index>(v) * kRows, kRows);
    poses[v].linear() = nearestRotation<Pose>(relaxed.transpose());
  }
}

/// Blocks are positions as rows: t_to = t_from + R_from t_from_to.
template <class Pose>
void startPositions(const PoseGraph<Pose>& graph, const std::vector<double>& weights,
                    const std::vector<bool>& anchors, std::vector<Pose>& poses) {
  Eigen::MatrixXd values(static_cast<Eigen::Index>(poses.size()), kAxes<Pose>);
  for (std::size_t v = 0; v < poses.size(); ++v)
    values.row(static_cast<Eigen::Index>(v)) = poses[v].translation().transpose();
  BlockSystem system(anchors, values, 1);
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const auto& edge = graph.edges[e];
    const double weight = (weights.empty() ? 1.0 : weights[e]) *
                          edge.information.template topLeftCorner<kAxes<Pose>, kAxes<Pose>>().trace() /
                          kAxes<Pose>;
    if (weight <= 0.0) continue;
    const auto step = poses[edge.from].linear() * edge.T_from_to.translation();
    system.add(edge.from, edge.to, weight, one, step.transpose());
  }
  const Eigen::MatrixXd& solved = system.solve();
  for (std::size_t v = 0; v < poses.size(); ++v)
    poses[v].translation() = solved.row(static_cast<Eigen::Index>(v)).transpose();
}

}  // namespace

template <class Pose>
std::vector<Pose> chordalStart(const PoseGraph<Pose>& graph, const std::vector<double>& weights) {
  auto poses = graph.poses;
  const std::vector<bool> anchors = anchorsOf(graph, weights);
  startRotations(graph, weights, anchors, poses);
  startPositions(graph, weights, anchors, poses);
  return poses;
}

template std::vector<Eigen::Isometry2d> chordalStart(const PlanarGraph&, const std::vector<double>&);
template std::vector<Eigen::Isometry3d> chordalStart(const SpatialGraph&, const std::vector<double>&);

}  // namespace stereo_nav::mapping
