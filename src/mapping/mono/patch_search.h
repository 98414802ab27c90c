#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "mapping/mono/mono_camera.h"
#include "mapping/mono/mono_params.h"
#include "mapping/mono/mono_state.h"

namespace stereo_nav::mapping {

/// What a landmark looked like when it was seen first, and from where.
struct FirstView {
  cv::Mat surroundings;  ///< CV_8UC1, with the border that vision::Patch reads
  cv::Point2f centre;    ///< of the landmark in `surroundings`, px
  Eigen::Vector2d px;    ///< of the landmark in its image
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

/// Keeps the surroundings of a pixel of level 0 of an ImagePyramid.
std::shared_ptr<const FirstView> keepView(const cv::Mat& image, const Eigen::Vector2d& px,
                                          const Eigen::Isometry3d& T_world_camera);

/// Px in the first view per px in the view from `now`, around the landmark: the homography of the plane
/// through the landmark that faces the first view, linearised. Nothing where the landmark has no such plane
/// in sight.
std::optional<Eigen::Matrix2f> warpOf(const MonoCamera& camera, const FirstView& view,
                                      const StateBlock& landmark, const CameraState& now,
                                      const Eigen::Vector2d& expected_px);

/// Where the image, level 0 of a pyramid, looks most like the landmark, within three standard deviations of
/// the expected pixel: zero-mean normalised correlation at each whole pixel of the ellipse of the innovation,
/// then a fraction of a pixel by Lucas-Kanade. Nothing where nothing there looks like it.
std::optional<Eigen::Vector2d> searchPatch(const cv::Mat& image, const FirstView& view,
                                           const Eigen::Matrix2f& warp, const Eigen::Vector2d& expected_px,
                                           const Eigen::Matrix2d& covariance,
                                           const PatchSearchParams& params);

}  // namespace stereo_nav::mapping
