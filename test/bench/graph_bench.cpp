// Processor time of optimising public pose graphs from the file's own guess, beside plain Ceres: automatic
// derivatives, its default options. Both by turns, medians of the times, from the graph in memory to the
// optimised poses.
//
//   graph_bench_test FOLDER_OF_G2O_FILES [TURNS]
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <array>
#include <cstdlib>

#include "core/processor_time.h"
#include "core/statistics.h"
#include "mapping/map/edge_error.h"
#include "mapping/map/g2o_file.h"
#include "mapping/map/graph_optimiser.h"
#include "mapping/map/pose_block.h"

namespace stereo_nav::mapping {
namespace {

struct PlainPlanarError {
  Eigen::Vector3d measured;
  Eigen::Matrix3d root;

  template <class T>
  bool operator()(const T* from, const T* to, T* residuals) const {
    using std::cos;
    using std::floor;
    using std::sin;
    const T x = to[0] - from[0], y = to[1] - from[1], c = cos(from[2]), s = sin(from[2]);
    const T dx = c * x + s * y - measured[0], dy = c * y - s * x - measured[1];
    const double cz = std::cos(measured[2]), sz = std::sin(measured[2]);
    const T angle = to[2] - from[2] - measured[2];
    Eigen::Matrix<T, 3, 1> error;
    error << cz * dx + sz * dy, cz * dy - sz * dx, angle - 2.0 * kPi * floor((angle + kPi) / (2.0 * kPi));
    Eigen::Map<Eigen::Matrix<T, 3, 1>>{residuals} = root.cast<T>() * error;
    return true;
  }
  static constexpr double kPi = 3.14159265358979323846;
};

struct PlainSpatialError {
  Eigen::Vector3d t;
  Eigen::Quaterniond q;
  Matrix6d root;

  template <class T>
  bool operator()(const T* t_from, const T* q_from, const T* t_to, const T* q_to, T* residuals) const {
    const Eigen::Map<const Eigen::Matrix<T, 3, 1>> p_from(t_from), p_to(t_to);
    const Eigen::Map<const Eigen::Quaternion<T>> r_from(q_from), r_to(q_to);
    const Eigen::Quaternion<T> inverse = q.conjugate().cast<T>();
    Eigen::Quaternion<T> turn = inverse * (r_from.conjugate() * r_to);
    if (turn.w() < T(0.0)) turn.coeffs() = -turn.coeffs();
    Eigen::Matrix<T, 6, 1> error;
    error.template head<3>() = inverse * (r_from.conjugate() * (p_to - p_from) - t.cast<T>());
    error.template tail<3>() = turn.vec();
    Eigen::Map<Eigen::Matrix<T, 6, 1>>{residuals} = root.cast<T>() * error;
    return true;
  }
};

ceres::Solver::Options plainOptions() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 200;
  options.logging_type = ceres::SILENT;
  return options;
}

void optimisePlainly(PlanarGraph& graph) {
  std::vector<std::array<double, 3>> blocks(graph.poses.size());
  ceres::Problem problem;
  for (std::size_t v = 0; v < blocks.size(); ++v)
    PoseBlock<Eigen::Isometry2d>::write(graph.poses[v], blocks[v].data());
  for (const auto& edge : graph.edges) {
    std::array<double, 3> measured{};
    PoseBlock<Eigen::Isometry2d>::write(edge.T_from_to, measured.data());
    auto* error = new PlainPlanarError{Eigen::Vector3d(measured.data()),
                                       edge.information.llt().matrixU().toDenseMatrix()};
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PlainPlanarError, 3, 3, 3>(error), nullptr,
                             blocks[edge.from].data(), blocks[edge.to].data());
  }
  problem.SetParameterBlockConstant(blocks[0].data());
  ceres::Solver::Summary summary;
  ceres::Solve(plainOptions(), &problem, &summary);
  for (std::size_t v = 0; v < blocks.size(); ++v)
    graph.poses[v] = PoseBlock<Eigen::Isometry2d>::read(blocks[v].data());
}

void optimisePlainly(SpatialGraph& graph) {
  std::vector<std::array<double, 7>> blocks(graph.poses.size());
  ceres::Problem problem;
  for (std::size_t v = 0; v < blocks.size(); ++v)
    PoseBlock<Eigen::Isometry3d>::write(graph.poses[v], blocks[v].data());
  for (const auto& edge : graph.edges) {
    auto* error =
        new PlainSpatialError{edge.T_from_to.translation(), Eigen::Quaterniond(edge.T_from_to.linear()),
                              edge.information.llt().matrixU().toDenseMatrix()};
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PlainSpatialError, 6, 3, 4, 3, 4>(error),
                             nullptr, blocks[edge.from].data(), blocks[edge.from].data() + 3,
                             blocks[edge.to].data(), blocks[edge.to].data() + 3);
  }
#if CERES_VERSION_MAJOR * 100 + CERES_VERSION_MINOR >= 201
  auto* turns = new ceres::EigenQuaternionManifold;
  for (auto& block : blocks) problem.SetManifold(block.data() + 3, turns);
#else
  auto* turns = new ceres::EigenQuaternionParameterization;
  for (auto& block : blocks) problem.SetParameterization(block.data() + 3, turns);
#endif
  problem.SetParameterBlockConstant(blocks[0].data());
  problem.SetParameterBlockConstant(blocks[0].data() + 3);
  ceres::Solver::Summary summary;
  ceres::Solve(plainOptions(), &problem, &summary);
  for (std::size_t v = 0; v < blocks.size(); ++v)
    graph.poses[v] = PoseBlock<Eigen::Isometry3d>::read(blocks[v].data());
}

template <class Graph, class Work>
double timed_ms(const Graph& start, double& chi_square, const Work& work) {
  Graph graph = start;
  const double start_ms = processorTime_ms();
  work(graph);
  const double end_ms = processorTime_ms();
  chi_square = chiSquare(graph);
  return end_ms - start_ms;
}

template <class Graph>
void compare(const std::string& name, const Graph& graph, int turns) {
  std::vector<double> plain_ms, ours_ms;
  double plain_chi = 0.0, ours_chi = 0.0;
  OptimiserResult result;
  for (int turn = 0; turn < turns; ++turn) {
    plain_ms.push_back(timed_ms(graph, plain_chi, [](Graph& g) { optimisePlainly(g); }));
    ours_ms.push_back(
        timed_ms(graph, ours_chi, [&result](Graph& g) { result = optimise(g, OptimiserParams()); }));
  }
  const double plain = quantile(plain_ms, 0.5), ours = quantile(ours_ms, 0.5);
  fmt::print(
      "{:22} chi-square {:10.6g} plain, {:10.6g} ours; {:8.1f} ms plain, {:8.1f} ms ours: ratio {:.3f} ({} iterations{})\n",
      name, plain_chi, ours_chi, plain, ours, ours / plain, result.iterations,
      result.chordal ? ", chordal start" : "");
}

}  // namespace
}  // namespace stereo_nav::mapping

int main(int argc, char** argv) {
  using namespace stereo_nav::mapping;
  if (argc < 2) {
    fmt::print(stderr, "usage: graph_bench_test FOLDER_OF_G2O_FILES [TURNS]\n");
    return 2;
  }
  const int turns = argc > 2 ? std::atoi(argv[2]) : 5;
  for (const char* name : {"intel", "manhattan", "kitti_05", "sphere2500", "parking-garage"})
    std::visit([&](const auto& graph) { compare(name, graph, turns); },
               readG2o(std::string(argv[1]) + "/" + name + ".g2o"));
  return 0;
}
