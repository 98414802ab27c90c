#include "odometry/stereo/frame_report.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "vision/pixel.h"

namespace stereo_nav::odometry {
namespace {

/// The errors of a feature are much the same in so many views that follow each other.
constexpr double kDependentViews = 3.0;

FeatureReport::Fate fate(const Track& track) {
  if (track.fresh) return FeatureReport::Fate::kDetected;
  if (track.inlier) return FeatureReport::Fate::kInlier;
  return track.at_stamp.has_right ? FeatureReport::Fate::kRejected : FeatureReport::Fate::kNoDepth;
}

}  // namespace

void reportTracks(const std::vector<Track>& tracks, const Eigen::Isometry3d& T_camera_world,
                  FrameResult& result) {
  for (const Track& track : tracks) {
    if (!track.found) continue;
    FeatureReport report;
    report.id = track.landmark_id;
    report.current_px = vision::toCv(track.in_image.left_px);
    report.previous_px = track.fresh ? report.current_px : vision::toCv(track.previous_px);
    report.fate = fate(track);
    report.p_camera = T_camera_world * track.p_world;
    if (report.fate == FeatureReport::Fate::kInlier) ++result.inliers;
    result.features.push_back(report);
  }
}

void reportKeyframe(const std::vector<Track>& tracks, const LocalMap& map,
                    const vision::StereoCalibration& calibration, FrameResult& result) {
  // Features are those of the found tracks, in their order.
  auto track = tracks.begin();
  for (FeatureReport& feature : result.features) {
    while (!track->found) ++track;
    const Track& source = *track++;
    feature.stamp_px = vision::toCv(source.at_stamp.left_px);
    const Landmark* landmark = map.find(source.landmark_id);
    if (landmark == nullptr || landmark->views.empty() || feature.p_camera.z() < vision::kNearestDepth_m)
      continue;
    feature.disparity_px = calibration.fx * calibration.baseline_m / feature.p_camera.z();
    const double views = std::max(1.0, static_cast<double>(landmark->views.size()) / kDependentViews);
    feature.disparity_sigma_px =
        vision::kPixelSigma_px * landmark->views.back().seen.noise * std::sqrt(2.0 / views);
  }
}

std::string tooFewLandmarks(std::size_t landmarks, int needed) {
  std::ostringstream message;
  message << "only " << landmarks << " features with depth, " << needed
          << " needed: dark, blocked or without texture; or the cameras are not those of the calibration";
  return message.str();
}

std::string tooFewInliers(std::size_t inliers, std::size_t tracked, int needed) {
  std::ostringstream message;
  message << "only " << inliers << " of " << tracked << " tracked features agree with one motion, " << needed
          << " needed: dark, blocked, without texture, moved too far, or moving objects fill the view";
  return message.str();
}

std::string blankImage(std::size_t corners) {
  std::ostringstream message;
  message << "the left image is blank, " << corners
          << " corners: dark, covered, or overexposed; the features seen before are waited for";
  return message.str();
}

std::string moverFillsView() {
  return "most of what is seen moves as no robot could have begun to within a frame: something that moves on "
         "its own fills the view; the features seen before are waited for";
}

std::string ambiguous() {
  return "two groups of features of nearly the same size tell of two motions, and nothing else decides between "
         "them: something that moves on its own, or that is fixed to the camera, covers half of the view";
}

std::string unconfirmed() {
  return "the map has just begun: its first motion is believed once the next frame confirms it";
}

void reportTimes(const FrameTimes& times, const RightStampError& stamps, FrameResult& result) {
  result.time_offset_compensated = times.rightOffset_s() != 0.0;
  result.right_stamps_are_corrected = stamps.takenOff_s() != 0.0;
  if (result.right_stamps_are_corrected) result.right_stamp_error_s = stamps.takenOff_s();
  const auto estimate = stamps.estimate();
  if (!estimate) return;
  result.right_stamp_error_s = estimate->error_s;
  result.right_stamp_sigma_s = estimate->sigma_s;
}

}  // namespace stereo_nav::odometry
