#include "vision/klt_tracker.h"

#include <opencv2/video/tracking.hpp>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::vision {

void KltParams::describe(ParameterVisitor& visitor) {
  visitor.integer("window", window, {3, 101}, "px", "side of the patch that is followed");
  visitor.integer("levels", levels, {0, 8}, "", "pyramid levels above the image itself");
  visitor.integer("iterations", iterations, {1, 100}, "", "most iterations per level");
  visitor.real("epsilon_px", epsilon_px, {1e-4, 1.0}, "px", "an iteration that moves less ends the level");
  visitor.real("min_eigenvalue", min_eigenvalue, {0.0, 1.0}, "", "patches with less texture are given up");
}

KltTracker::KltTracker(const KltParams& params) : params_(params) {
  validateParameters(params, "tracking");
}

std::vector<KltTracker::Track> KltTracker::track(const cv::Mat& previous, const cv::Mat& current,
                                                 const std::vector<cv::Point2f>& previous_points) const {
  std::vector<Track> tracks(previous_points.size());
  if (previous_points.empty()) return tracks;

  std::vector<cv::Point2f> positions;
  std::vector<unsigned char> found;
  const cv::TermCriteria criteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, params_.iterations,
                                  params_.epsilon_px);
  cv::calcOpticalFlowPyrLK(previous, current, previous_points, positions, found, cv::noArray(),
                           cv::Size(params_.window, params_.window), params_.levels, criteria, 0,
                           params_.min_eigenvalue);

  const auto columns = static_cast<float>(current.cols - 1);
  const auto rows = static_cast<float>(current.rows - 1);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const cv::Point2f& p = positions[i];
    tracks[i].position = p;
    tracks[i].found = found[i] != 0 && p.x >= 0.0F && p.y >= 0.0F && p.x <= columns && p.y <= rows;
  }
  return tracks;
}

}  // namespace stereo_nav::vision
