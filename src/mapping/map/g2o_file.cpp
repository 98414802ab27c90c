#include "mapping/map/g2o_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::mapping {
namespace {

template <class Pose>
struct G2oTags;
template <>
struct G2oTags<Eigen::Isometry2d> {
  static constexpr const char *kVertex = "VERTEX_SE2", *kEdge = "EDGE_SE2";
  static constexpr std::size_t kNumbers = 3;
};
template <>
struct G2oTags<Eigen::Isometry3d> {
  static constexpr const char *kVertex = "VERTEX_SE3:QUAT", *kEdge = "EDGE_SE3:QUAT";
  static constexpr std::size_t kNumbers = 7;
};

void readPose(const TextRow& row, std::size_t column, Eigen::Isometry2d& pose) {
  pose = Eigen::Translation2d(row.number(column), row.number(column + 1)) *
         Eigen::Rotation2Dd(row.number(column + 2));
}

void readPose(const TextRow& row, std::size_t column, Eigen::Isometry3d& pose) {
  Eigen::Quaterniond q(row.number(column + 6), row.number(column + 3), row.number(column + 4),
                       row.number(column + 5));
  if (q.norm() < 0.9 || q.norm() > 1.1)
    throw InputError(
        fmt::format("{}: the quaternion has the length {:.4g}, which is to be 1; are columns missing?",
                    row.source, q.norm()));
  pose = Eigen::Translation3d(row.number(column), row.number(column + 1), row.number(column + 2)) *
         q.normalized();
}

void requireColumns(const TextRow& row, std::size_t columns) {
  if (row.fields.size() != columns)
    throw InputError(fmt::format("{}: {} has {} columns, {} are needed; is the file cut off?", row.source,
                                 row.fields[0], row.fields.size(), columns));
}

/// The graph as it stands in the file, by ids.
template <class Pose>
class G2oReader {
  using Tags = G2oTags<Pose>;
  static constexpr int kDof = Motion<Pose>::kDof;

 public:
  explicit G2oReader(const std::vector<TextRow>& rows) {
    for (const TextRow& row : rows) read(row);
  }

  PoseGraph<Pose> graph(const std::string& path) {
    if (edges_.empty()) throw InputError(path + ": no edges; is it a pose graph in g2o's format?");
    const bool without_vertices = poses_.empty();
    for (const auto& edge : edges_) {
      for (const long long id : {edge.from, edge.to}) {
        if (without_vertices) poses_.emplace(id, Pose::Identity());
        if (poses_.count(id) == 0)
          throw InputError(fmt::format(
              "{}: no vertex {} in the file, which this edge joins; is the file cut off?", edge.source, id));
      }
    }
    return numbered(without_vertices);
  }

 private:
  struct Edge {
    std::string source;
    long long from, to;
    GraphEdge<Pose> edge;
  };

  void read(const TextRow& row) {
    const std::string& tag = row.fields[0];
    if (tag == Tags::kVertex) {
      readVertex(row);
    } else if (tag == Tags::kEdge) {
      readEdge(row);
    } else if (tag == "FIX" && !fixed_) {
      fixed_ = true;
    } else {
      throw InputError(fmt::format(
          "{}: '{}' cannot be used beside {} and {}; graphs of poses in the plane or in space, one kind a file, are read",
          row.source, tag, Tags::kVertex, Tags::kEdge));
    }
  }

  void readVertex(const TextRow& row) {
    requireColumns(row, 2 + Tags::kNumbers);
    Pose pose;
    readPose(row, 2, pose);
    const long long id = row.integer(1);
    if (!poses_.emplace(id, pose).second)
      throw InputError(fmt::format("{}: vertex {} comes twice; are two files joined?", row.source, id));
  }

  void readEdge(const TextRow& row) {
    constexpr std::size_t kTriangle = kDof * (kDof + 1) / 2;
    requireColumns(row, 3 + Tags::kNumbers + kTriangle);
    Edge edge{row.source, row.integer(1), row.integer(2), {}};
    if (edge.from == edge.to)
      throw InputError(fmt::format("{}: an edge from vertex {} to itself", row.source, edge.from));
    readPose(row, 3, edge.edge.T_from_to);
    std::size_t column = 3 + Tags::kNumbers;
    for (int r = 0; r < kDof; ++r)
      for (int c = r; c < kDof; ++c)
        edge.edge.information(r, c) = edge.edge.information(c, r) = row.number(column++);
    if (edge.edge.information.llt().info() != Eigen::Success)
      throw InputError(
          row.source +
          ": the information is not positive definite; is it the covariance, or in another order than the upper triangle row by row?");
    edges_.push_back(std::move(edge));
  }

  PoseGraph<Pose> numbered(bool without_vertices) const {
    PoseGraph<Pose> graph;
    std::map<long long, std::size_t> index;
    for (const auto& [id, pose] : poses_) {
      index[id] = graph.ids.size();
      graph.ids.push_back(id);
      graph.poses.push_back(pose);
    }
    for (const auto& edge : edges_) {
      graph.edges.push_back(edge.edge);
      graph.edges.back().from = index.at(edge.from);
      graph.edges.back().to = index.at(edge.to);
    }
    if (without_vertices) chainPoses(graph);
    return graph;
  }

  bool fixed_ = false;
  std::map<long long, Pose> poses_;
  std::vector<Edge> edges_;
};

bool isSpatial(const TextRow& row) {
  return row.fields[0] == G2oTags<Eigen::Isometry3d>::kVertex ||
         row.fields[0] == G2oTags<Eigen::Isometry3d>::kEdge;
}

std::string numbers(const Eigen::Isometry2d& T) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", T.translation().x(), T.translation().y(), yawOf(T));
}

std::string numbers(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  return fmt::format("{:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}", T.translation().x(),
                     T.translation().y(), T.translation().z(), q.x(), q.y(), q.z(), q.w());
}

template <class Pose>
std::string textOf(const PoseGraph<Pose>& graph) {
  std::string text;
  for (std::size_t v = 0; v < graph.poses.size(); ++v)
    text += fmt::format("{} {} {}\n", G2oTags<Pose>::kVertex, graph.ids[v], numbers(graph.poses[v]));
  for (const auto& edge : graph.edges) {
    text += fmt::format("{} {} {} {}", G2oTags<Pose>::kEdge, graph.ids[edge.from], graph.ids[edge.to],
                        numbers(edge.T_from_to));
    for (int r = 0; r < Motion<Pose>::kDof; ++r)
      for (int c = r; c < Motion<Pose>::kDof; ++c) text += fmt::format(" {:.17g}", edge.information(r, c));
    text += "\n";
  }
  return text;
}

}  // namespace

AnyGraph readG2o(const std::string& path) {
  const std::vector<TextRow> rows = readTextTable(path);
  if (std::any_of(rows.begin(), rows.end(), isSpatial)) return G2oReader<Eigen::Isometry3d>(rows).graph(path);
  return G2oReader<Eigen::Isometry2d>(rows).graph(path);
}

std::string toG2o(const PlanarGraph& graph) {
  return textOf(graph);
}

std::string toG2o(const SpatialGraph& graph) {
  return textOf(graph);
}

}  // namespace stereo_nav::mapping
