#include "odometry/stereo/rigid_selection.h"

#include "odometry/common/exact_clique.h"

namespace stereo_nav::odometry {
namespace {

TrackIndices candidates(const std::vector<Track>& tracks, std::size_t most) {
  TrackIndices result;
  for (const std::size_t i : foundTracks(tracks)) {
    if (tracks[i].at_stamp.has_right && tracks[i].reliable) result.push_back(i);
  }
  const std::size_t all = result.size();
  if (all <= most) return result;
  // Tracks are in the order of their detection: old and young ones are taken alike.
  for (std::size_t k = 0; k < most; ++k) result[k] = result[k * all / most];
  result.resize(most);
  return result;
}

}  // namespace

void CliqueParams::describe(ParameterVisitor& visitor) {
  visitor.integer(
      "clique_points", clique_points, {10, 5000}, "",
      "most features among which the largest rigid set is searched; the work grows with its square");
  visitor.integer("clique_budget", clique_budget, {0, 10000000}, "",
                  "most nodes expanded in search of the largest rigid set");
}

RigidSelection selectRigidTracks(const CliqueParams& params, const NoisyRigidityParams& rigidity,
                                 const vision::StereoCalibration& calibration,
                                 const Eigen::Isometry3d& T_previous_world, const vision::StereoView& view,
                                 const std::vector<Track>& tracks) {
  TrackIndices with_depth;
  std::vector<RigidPoint> points;
  for (const std::size_t i : candidates(tracks, static_cast<std::size_t>(params.clique_points))) {
    const vision::StereoObservation& seen = tracks[i].at_stamp;
    const vision::Triangulation depth =
        vision::triangulate(calibration, view.T_late_camera, seen.left_px, seen.right_px);
    if (depth.inverse_depth <= 0.0) continue;
    with_depth.push_back(i);
    points.push_back({T_previous_world * tracks[i].p_world,
                      vision::leftRay(calibration, seen.left_px) / depth.inverse_depth});
  }
  const CliqueResult clique = largestClique(buildNoisyRigidityGraph(rigidity, calibration, points),
                                            static_cast<std::size_t>(params.clique_budget));
  RigidSelection selection;
  selection.with_depth = with_depth.size();
  for (const std::size_t member : clique.members) selection.tracks.push_back(with_depth[member]);
  return selection;
}

}  // namespace stereo_nav::odometry
