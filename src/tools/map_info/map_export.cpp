#include "tools/map_info/map_export.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/angles.h"
#include "mapping/map/covisibility_graph.h"

namespace stereo_nav::tools {
namespace {

std::string plyPoint(const Eigen::Vector3d& p, const char* colour) {
  return fmt::format("{:.6g} {:.6g} {:.6g} {}\n", p.x(), p.y(), p.z(), colour);
}

std::string describeWorld(const mapping::WorldTransform& world) {
  const Eigen::AngleAxisd turn(world.T_world_map.R_target_source);
  const Eigen::Vector3d& t = world.T_world_map.t_target_m;
  std::string text = fmt::format(
      "  in the world: turned by {:.3f} deg about ({:.3f}, {:.3f}, {:.3f}), scale {:.6g}, moved by ({:.4f}, {:.4f}, {:.4f}) m\n"
      "    {:.4f} m RMS over {} pairs:",
      turn.angle() * kDegPerRad, turn.axis().x(), turn.axis().y(), turn.axis().z(), world.T_world_map.scale,
      t.x(), t.y(), t.z(), world.rms_m, world.residuals_m.size());
  for (const double residual_m : world.residuals_m) text += fmt::format(" {:.4f}", residual_m);
  return text + "\n";
}

}  // namespace

Trajectory keyframePoses(const mapping::VisualMap& map, const Similarity& T_target_map) {
  Trajectory poses;
  for (const auto& keyframe : map.keyframes) {
    StampedPose pose{keyframe.keyframe.time_s, Eigen::Isometry3d::Identity()};
    pose.T_world_body.linear() = T_target_map.R_target_source * keyframe.T_map_camera.linear();
    pose.T_world_body.translation() = T_target_map * keyframe.T_map_camera.translation();
    poses.push_back(pose);
  }
  return poses;
}

std::string toPly(const mapping::VisualMap& map, const Similarity& T_target_map) {
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      map.landmarks.size() + map.keyframes.size());
  for (const auto& landmark : map.landmarks) text += plyPoint(T_target_map * landmark.p_map, "22 104 179");
  for (const auto& keyframe : map.keyframes)
    text += plyPoint(T_target_map * keyframe.T_map_camera.translation(), "201 48 44");
  return text;
}

std::string describe(const mapping::VisualMap& map) {
  std::size_t corners = 0, descriptors = 0;
  std::vector<Eigen::Vector3d> positions_m;
  for (const auto& keyframe : map.keyframes) {
    corners += keyframe.keyframe.corners.size();
    descriptors += keyframe.keyframe.descriptors.size();
    positions_m.push_back(keyframe.T_map_camera.translation());
  }
  const auto kept =
      std::count_if(map.loops.begin(), map.loops.end(), [](const auto& loop) { return loop.kept; });
  const auto covisible = mapping::covisibilityGraph(map);
  std::string text = fmt::format("  calibration {:016x}\n  {} keyframes with {} corners and {} descriptors",
                                 map.calibration_hash, map.keyframes.size(), corners, descriptors);
  if (!map.keyframes.empty())
    text += fmt::format(", {:.3f} s to {:.3f} s, {:.3f} m of way", map.keyframes.front().keyframe.time_s,
                        map.keyframes.back().keyframe.time_s, pathLength(positions_m));
  text += fmt::format(
      "\n  {} landmarks; covisibility graph with {} edges, spanning tree with {}\n  {} loops, of which {} are kept\n",
      map.landmarks.size(), covisible.size(), mapping::spanningTree(map.keyframes.size(), covisible).size(),
      map.loops.size(), kept);
  return text + (map.world ? describeWorld(*map.world) : "  not set in the world\n");
}

}  // namespace stereo_nav::tools
