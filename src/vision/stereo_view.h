#pragma once

#include <Eigen/Geometry>

#include "stereo_nav/core/lie.h"
#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::vision {

/// Where the rig was when a stereo frame was taken. The right image of two free-running cameras is taken at
/// another time than the left one; between the two stamps the whole rig moves by T_late_camera.
struct StereoView {
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();  ///< left camera at the left stamp
  /// Left camera at the left stamp -> left camera at the right stamp; identity for a synchronous pair.
  Eigen::Isometry3d T_late_camera = Eigen::Isometry3d::Identity();
};

/// One point in the two images of a frame; every image has its own time.
struct StereoObservation {
  Eigen::Vector2d left_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d right_px = Eigen::Vector2d::Zero();
  bool has_left = true;
  bool has_right = false;
  double noise = 1.0;  ///< of the pixels, relative to what a sharp image gives
};

/// Points nearer to the image plane than this are not projected. No two cameras see a point at one centimetre
/// together, and the derivatives of the projection, which grow with 1/depth^2, stay within sound numbers.
constexpr double kNearestDepth_m = 1e-2;

/// Noise of a tracked or matched position in a sharp image, per coordinate.
constexpr double kPixelSigma_px = 0.3;

/// Pixel of a point; z must be at least kNearestDepth_m. `p_late` is in the left camera's frame at the right
/// stamp.
Eigen::Vector2d projectLeft(const StereoCalibration& calibration, const Eigen::Vector3d& p_camera);
Eigen::Vector2d projectRight(const StereoCalibration& calibration, const Eigen::Vector3d& p_late);

/// The derivative of either projection by its point.
Eigen::Matrix<double, 2, 3> leftProjectionJacobian(const StereoCalibration& calibration,
                                                   const Eigen::Vector3d& p_camera);
Eigen::Matrix<double, 2, 3> rightProjectionJacobian(const StereoCalibration& calibration,
                                                    const Eigen::Vector3d& p_late);

/// Point at depth 1 on the ray of a pixel of the left image.
Eigen::Vector3d leftRay(const StereoCalibration& calibration, const Eigen::Vector2d& left_px);

/// Pixel of the right image where a point on the ray of `left_px` at 1/depth `inverse_depth` (1/m, 0 is
/// infinity) appears; NaN if it is not in front of the camera.
Eigen::Vector2d transferToRight(const StereoCalibration& calibration, const Eigen::Isometry3d& T_late_camera,
                                const Eigen::Vector2d& left_px, double inverse_depth);

/// A point on the ray of a left pixel, from its right pixel.
struct Triangulation {
  double inverse_depth;  ///< 1/m; <= 0 if the rays diverge
  double epipolar_px;    ///< distance of the right pixel from where the point projects to, signed by row
  double px_per_inverse_depth;  ///< how far the right pixel moves per 1/m: sigma = sigma_px / this
};
/// Depth along the ray of `left_px` that projects nearest to `right_px`, whatever the two stamps.
Triangulation triangulate(const StereoCalibration& calibration, const Eigen::Isometry3d& T_late_camera,
                          const Eigen::Vector2d& left_px, const Eigen::Vector2d& right_px);

}  // namespace stereo_nav::vision
