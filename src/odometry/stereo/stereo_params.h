#pragma once

#include "odometry/stereo/imu_rotation.h"
#include "odometry/stereo/keyframe_decision.h"
#include "odometry/stereo/motion_model.h"
#include "odometry/stereo/pose_estimator.h"
#include "odometry/stereo/rigid_selection.h"
#include "odometry/stereo/window_optimizer.h"
#include "vision/grid_corner_detector.h"
#include "vision/patch_tracker.h"
#include "vision/sparse_stereo.h"

namespace stereo_nav::odometry {

/// All parameters of StereoOdometry, a section for each of its stages.
struct StereoParams {
  int pyramid_levels = 4;
  vision::GridCornerDetectorParams corners;
  vision::PatchTrackerParams tracking;
  vision::SparseStereoParams stereo;
  NoisyRigidityParams rigidity;
  CliqueParams clique;
  PoseEstimatorParams motion;
  WindowOptimizerParams window;
  KeyframeParams keyframes;
  ImuRotationParams imu;
  int min_inliers = 12;
  int max_lost_frames = 3;
  double coasting_s = 1.0;
  MotionModelParams motion_model;

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::odometry
