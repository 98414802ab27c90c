#include "odometry/stereo/track.h"

#include <algorithm>

namespace stereo_nav::odometry {

TrackIndices foundTracks(const std::vector<Track>& tracks) {
  TrackIndices found;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (tracks[i].found) found.push_back(i);
  }
  return found;
}

std::size_t aliveTracks(const std::vector<Track>& tracks) {
  return static_cast<std::size_t>(
      std::count_if(tracks.begin(), tracks.end(), [](const Track& track) { return track.alive; }));
}

void selectReliableTracks(int min_inliers, std::vector<Track>& tracks) {
  constexpr int kConfirmations = 3;
  const int enough = min_inliers + min_inliers / 2;
  int required = kConfirmations;
  const auto proven = [&required](const Track& track) {
    return track.found && track.confirmations >= required;
  };
  while (required > 0 && std::count_if(tracks.begin(), tracks.end(), proven) < enough) --required;
  for (Track& track : tracks) track.reliable = proven(track);
}

void compensateRollingShutter(const vision::RollingShutter& shutter, const vision::StereoView& view,
                              const Vector6d& twist, std::vector<Track>& tracks) {
  for (Track& track : tracks) {
    if (!track.found) continue;
    track.at_stamp =
        shutter.atStamp(track.in_image, view.T_camera_world * track.p_world, view.T_late_camera, twist);
  }
}

Eigen::Vector2d predictedPixel(const vision::StereoCalibration& calibration, const vision::StereoView& view,
                               const Track& track) {
  const Eigen::Vector3d p_camera = view.T_camera_world * track.p_world;
  return p_camera.z() < vision::kNearestDepth_m ? track.previous_px
                                                : vision::projectLeft(calibration, p_camera);
}

TrackIndices tracksNear(const vision::StereoCalibration& calibration, const vision::StereoView& view,
                        double max_error_px, const std::vector<Track>& tracks) {
  TrackIndices near;
  for (const std::size_t i : foundTracks(tracks)) {
    const Eigen::Vector2d error_px =
        predictedPixel(calibration, view, tracks[i]) - tracks[i].at_stamp.left_px;
    if (error_px.norm() <= max_error_px) near.push_back(i);
  }
  return near;
}

std::vector<MapObservation> observations(const std::vector<Track>& tracks, const TrackIndices& selected) {
  std::vector<MapObservation> result;
  for (const std::size_t i : selected)
    result.push_back({tracks[i].p_world, tracks[i].at_stamp, tracks[i].reliable});
  return result;
}

}  // namespace stereo_nav::odometry
