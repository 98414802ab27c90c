#pragma once

#include <vector>

#include "odometry/common/consistency_graph.h"
#include "stereo_nav/core/parameter_visitor.h"
#include "vision/stereo_view.h"

namespace stereo_nav::odometry {

struct NoisyRigidityParams {
  double disparity_sigma_px = vision::kPixelSigma_px;
  double pixel_sigma_px = vision::kPixelSigma_px;
  double gate_sigmas = 3.0;

  void describe(ParameterVisitor& visitor);
};

/// The same point of two frames, both in the left optical frame of their time, m.
struct RigidPoint {
  Eigen::Vector3d before;
  Eigen::Vector3d now;
};

/// Which pairs of points kept their distance, as far as the noise of their triangulation lets one tell
/// (Hirschmueller, Innocent and Garibaldi 2002): the change of the distance against its own propagated sigma.
/// Far points have large sigmas and agree with everything; they still serve for the rotation.
ConsistencyGraph buildNoisyRigidityGraph(const NoisyRigidityParams& params,
                                         const vision::StereoCalibration& calibration,
                                         const std::vector<RigidPoint>& points);

}  // namespace stereo_nav::odometry
