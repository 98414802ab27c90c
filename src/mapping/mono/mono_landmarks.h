#pragma once

#include "mapping/mono/mono_camera.h"
#include "mapping/mono/mono_state.h"

namespace stereo_nav::mapping {

/// What is known of a landmark's depth when it is seen first.
struct DepthPrior {
  double rho;        ///< 1/m
  double rho_sigma;  ///< 1/m
};

/// Adds a landmark that is seen at a pixel, in inverse depth (Civera et al. 2008, section III-B). The
/// camera's state is that of the middle row. Returns it.
StateBlock& addInverseDepth(MonoState& state, const MonoCamera& camera, const Eigen::Vector2d& px,
                            double pixel_sigma_px, const DepthPrior& depth, double readout_s);

/// Adds a landmark whose place is known beforehand, to `sigma_m` in each axis.
StateBlock& addKnownPoint(MonoState& state, const Eigen::Vector3d& p_world, double sigma_m);

/// Turns each landmark whose linearity index is below the threshold into a point (X, Y, Z).
void convertToPoints(MonoState& state, double linearity_index);

}  // namespace stereo_nav::mapping
