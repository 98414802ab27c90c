// Optimises a pose graph in g2o's format and writes what came out.
#include <cmath>
#include <cstdio>

#include "core/atomic_file.h"
#include "core/processor_time.h"
#include "eval/gnuplot.h"
#include "mapping/map/edge_error.h"
#include "mapping/map/false_loops.h"
#include "stereo_nav/core/trajectory.h"
#include "tools/common/program.h"
#include "tools/optimise_graph/graph_report.h"
#include "tools/optimise_graph/optimise_options.h"

namespace stereo_nav::tools {
namespace {

using mapping::PoseGraph;

Eigen::Isometry3d spatial(const Eigen::Isometry2d& T) {
  return inSpace(T);
}
Eigen::Isometry3d spatial(const Eigen::Isometry3d& T) {
  return T;
}

template <class Pose>
std::vector<Eigen::Vector3d> positions(const PoseGraph<Pose>& graph) {
  std::vector<Eigen::Vector3d> positions_m;
  for (const Pose& T : graph.poses) positions_m.push_back(spatial(T).translation());
  return positions_m;
}

/// Vertices have no times: their ids stand for seconds.
template <class Pose>
Trajectory trajectory(const PoseGraph<Pose>& graph) {
  Trajectory poses;
  for (std::size_t v = 0; v < graph.poses.size(); ++v)
    poses.push_back({static_cast<double>(graph.ids[v]), spatial(graph.poses[v])});
  return poses;
}

/// Adds false loops and measures how far the graph comes out from its optimum without them.
template <class Pose>
std::vector<Eigen::Vector3d> spoil(const OptimiseOptions& options, PoseGraph<Pose>& graph, GraphRun& run) {
  PoseGraph<Pose> clean = graph;
  mapping::optimise(clean, options.params.optimiser);
  const std::size_t first = mapping::addFalseLoops(graph, options.false_loops_percent / 100.0, options.seed);
  run.false_loops = graph.edges.size() - first;
  return positions(clean);
}

template <class Pose>
void describeGraph(const PoseGraph<Pose>& graph, GraphRun& run) {
  run.vertices = graph.poses.size();
  run.edges = graph.edges.size();
  for (const bool is_loop : mapping::loopsOf(graph)) run.loops += is_loop ? 1 : 0;
  run.ids = graph.ids;
  for (const auto& edge : graph.edges) run.ends.emplace_back(edge.from, edge.to);
  run.before_m = positions(graph);
}

double rms(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

template <class Pose>
GraphRun runGraph(const OptimiseOptions& options, PoseGraph<Pose>& graph) {
  GraphRun run;
  run.file = options.file;
  run.robust = options.robust;
  std::vector<Eigen::Vector3d> clean_m;
  if (options.false_loops_percent > 0.0) clean_m = spoil(options, graph, run);
  describeGraph(graph, run);
  const double before = mapping::chiSquare(graph), start_ms = processorTime_ms();
  if (options.robust) {
    run.judgement = mapping::optimiseRobustly(graph, options.params);
    run.optimiser = run.judgement.optimiser;
    run.optimiser.chi_square_before = before;
  } else {
    run.optimiser = mapping::optimise(graph, options.params.optimiser);
  }
  run.processor_time_ms = processorTime_ms() - start_ms;
  run.after_m = positions(graph);
  if (!clean_m.empty()) run.rms_from_clean_m = rms(run.after_m, clean_m);
  return run;
}

template <class Pose>
void process(const OptimiseOptions& options, PoseGraph<Pose>& graph) {
  const GraphRun run = runGraph(options, graph);
  const std::string folder = options.output + "/";
  writeFileAtomically(folder + "graph.g2o", mapping::toG2o(graph));
  writeFileAtomically(folder + "trajectory.tum", toTum(trajectory(graph)));
  writeFileAtomically(folder + "summary.json", toJson(run));
  if (options.robust) writeFileAtomically(folder + "loops.csv", loopsCsv(run));
  print(run);
  try {
    writeFileAtomically(folder + "graph.svg", eval::runGnuplot(pictureScript(run), folder + "graph"));
  } catch (const eval::GnuplotError& error) {
    std::fprintf(stderr, "optimise_graph: %s\n", error.what());
  }
  std::printf("results in %s\n", options.output.c_str());
}

int run(int argc, char** argv) {
  const auto options = parseOptimiseOptions(argc, argv);
  if (!options) return 0;
  mapping::AnyGraph graph = mapping::readG2o(options->file);
  { const AtomicFile writable(options->output + "/summary.json"); }  // before the work, not after it
  std::visit([&](auto& any) { process(*options, any); }, graph);
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("optimise_graph", stereo_nav::tools::run, argc, argv);
}
