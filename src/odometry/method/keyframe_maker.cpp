#include "odometry/method/keyframe_maker.h"

#include <algorithm>
#include <vector>

#include "vision/corner_describer.h"
#include "vision/pixel.h"

namespace stereo_nav::odometry {

std::optional<vision::Keyframe> KeyframeMaker::add(const StereoFrame& frame, const FrameResult& result) {
  // An odometry that begins anew counts from one again.
  if (result.new_map || (result.keyframe && result.keyframe_id <= source_id_)) pause();
  if (isMeasured(result.state) && !result.new_map && result.motion_covariance.allFinite()) {
    const Matrix6d carry = adjoint(result.T_previous_current.inverse());
    covariance_ = carry * covariance_ * carry.transpose() + result.motion_covariance;
  }
  if (!result.keyframe) return std::nullopt;
  vision::Keyframe keyframe = describe(frame, result);
  if (keyframe.corners.empty()) return std::nullopt;
  keyframe.follows = has_previous_;
  if (has_previous_) {
    keyframe.T_previous_keyframe = T_start_previous_.inverse() * result.T_start_camera;
    keyframe.covariance = covariance_;
  }
  has_previous_ = true;
  T_start_previous_ = result.T_start_camera;
  covariance_.setZero();
  return keyframe;
}

vision::Keyframe KeyframeMaker::describe(const StereoFrame& frame, const FrameResult& result) {
  if (!has_previous_) landmark_offset_ = newest_landmark_;
  source_id_ = result.keyframe_id;
  id_ = std::max(id_ + 1, result.keyframe_id);
  vision::Keyframe keyframe;
  keyframe.id = id_;
  keyframe.time_s = frame.left_time_s;
  std::vector<cv::Point2f> corners;
  for (const FeatureReport& feature : result.features) {
    if (!(feature.disparity_px > 0.0)) continue;
    keyframe.corners.push_back({feature.id + landmark_offset_, vision::toEigen(feature.stamp_px),
                                feature.disparity_px, feature.disparity_sigma_px});
    corners.push_back(feature.current_px);
    newest_landmark_ = std::max(newest_landmark_, feature.id + landmark_offset_);
  }
  keyframe.descriptors = vision::describeCorners(frame.left, corners);
  return keyframe;
}

}  // namespace stereo_nav::odometry
