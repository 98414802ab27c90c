#include "odometry/stereo/landmark_detector.h"

#include "vision/pixel.h"

namespace stereo_nav::odometry {

void placeAtStamp(const vision::StereoCalibration& calibration, const vision::RollingShutter& shutter,
                  const vision::StereoView& view, const Vector6d& twist, Landmark& landmark,
                  vision::StereoObservation& seen) {
  landmark.ray_depth = shutter.rayDepthAtStamp(seen.left_px, landmark.ray_depth.z(), twist);
  if (shutter.isGlobal()) return;
  // The left and the right row have times of their own, so that the depth was one of a moving point.
  seen = shutter.atStamp(seen, view.T_camera_world * landmark.p_world(), view.T_late_camera, twist);
  const vision::Triangulation still =
      vision::triangulate(calibration, view.T_late_camera, seen.left_px, seen.right_px);
  if (still.inverse_depth <= 0.0) return;
  landmark.ray_depth = vision::leftRay(calibration, seen.left_px);
  landmark.ray_depth.z() = still.inverse_depth;
}

std::size_t LandmarkDetector::countCorners(const vision::ImagePyramid& left) {
  return detector_.detect(left.level(0), {}).size();
}

LandmarkDetector::Result LandmarkDetector::detect(const Frame& frame, const std::vector<Track>& tracks,
                                                  const RightImageMatcher& matcher) {
  std::vector<cv::Point2f> occupied;
  for (const Track& track : tracks) {
    if (track.alive) occupied.push_back(vision::toCv(track.in_image.left_px));
  }
  const Eigen::Isometry3d T_world_camera = frame.view.T_camera_world.inverse();
  const std::vector<cv::Point2f> corners = detector_.detect(frame.images.left.level(0), occupied);
  Result result{{}, corners.size()};
  for (const cv::Point2f& corner : corners) {
    const Eigen::Vector2d px = vision::toEigen(corner);
    const auto match = matcher.search(frame.images, frame.view, px, frame.slack_px);
    if (!match) continue;
    NewLandmark found;
    found.landmark.T_world_anchor = T_world_camera;
    found.landmark.ray_depth.z() = match->depth.inverse_depth;
    found.in_image.left_px = px;
    found.in_image.right_px = match->right_px;
    found.in_image.has_right = true;
    found.at_stamp = found.in_image;
    placeAtStamp(calibration_, frame.shutter, frame.view, frame.twist, found.landmark, found.at_stamp);
    result.landmarks.push_back(found);
  }
  return result;
}

}  // namespace stereo_nav::odometry
