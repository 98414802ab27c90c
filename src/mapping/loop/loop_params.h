#pragma once

#include "mapping/loop/landmark_search.h"
#include "mapping/loop/place_index.h"
#include "mapping/loop/pose_ransac.h"

namespace stereo_nav::mapping {

struct VerificationParams {
  int max_distance = 64;
  int min_matches = 15;
  int min_pose_inliers = 10;
  int min_inliers = 20;
  double max_sigma_m = 0.02;
  RansacParams ransac;
  LandmarkSearchParams search;

  void describe(ParameterVisitor& visitor);
};

struct AcceptanceParams {
  int agreeing = 1;
  int within_keyframes = 3;
  double consistency_share = 0.999;
  double drift_share = 0.9999;

  void describe(ParameterVisitor& visitor);
};

/// Parameters of recognising places: config/loop.yaml.
struct LoopParams {
  RetrievalParams retrieval;
  VerificationParams verification;
  DriftParams drift;
  AcceptanceParams acceptance;

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::mapping
