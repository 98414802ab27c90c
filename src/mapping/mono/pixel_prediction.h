#pragma once

#include <optional>

#include "mapping/mono/mono_camera.h"
#include "mapping/mono/mono_state.h"

namespace stereo_nav::mapping {

/// Where a landmark is expected in the image, with the derivatives by the state.
struct ExpectedPixel {
  Eigen::Vector2d px;
  Eigen::Matrix<double, 2, kCameraRows> by_camera;
  Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, 6> by_landmark;  ///< 2 x block.rows()
  Eigen::Matrix<double, 2, 3> by_direction;  ///< to the landmark, rho (p_first - p) + m, axes of the world
};

/// The image of a landmark: p_camera = R^T (rho (p_first - p) + m), or R^T (X - p) (Montiel, Civera and
/// Davison 2006, eq. 7). A rolling shutter takes `readout_s` from the first to the last row; the camera's
/// state is that of the middle row, the row's own pose is extrapolated by v and omega. Nothing for what is
/// not before the camera.
std::optional<ExpectedPixel> expectedPixel(const MonoCamera& camera, const CameraState& state,
                                           const StateBlock& landmark, double readout_s);

/// The same without derivatives.
std::optional<Eigen::Vector2d> pixelOf(const MonoCamera& camera, const CameraState& state,
                                       const StateBlock& landmark, double readout_s);

/// P H^T of one landmark, size x 2.
Eigen::Matrix<double, Eigen::Dynamic, 2> covarianceWith(const MonoState& state, const StateBlock& landmark,
                                                        const ExpectedPixel& expected);

/// Noise of a found pixel: that of the search and, of a landmark in inverse depth, the second-order term of
/// rho (p_first - p), var(rho) cov(p_first - p). While the camera has moved less than it knows, the
/// first-order term by rho is nearly 0, and without this one a near landmark, which has moved in the image,
/// would contradict the far ones, which have not.
Eigen::Matrix2d pixelNoise(const MonoState& state, const StateBlock& landmark, const ExpectedPixel& expected,
                           double pixel_sigma_px);

/// Covariance of the pixel that will be found: H P H^T + pixelNoise().
Eigen::Matrix2d innovationCovariance(const MonoState& state, const StateBlock& landmark,
                                     const ExpectedPixel& expected, double pixel_sigma_px);

}  // namespace stereo_nav::mapping
