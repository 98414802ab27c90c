#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"
#include "vision/keyframe.h"

namespace stereo_nav::mapping {

/// What the odometry's own covariance leaves out: errors of the calibration are the same in all motions and
/// grow with the way, not with its root.
struct DriftParams {
  double share = 0.01;
  double turn_rad_per_m = 0.003;

  void describe(ParameterVisitor& visitor);
};

/// A pose of one keyframe in another with its covariance, of the right perturbation: m, m, m, rad, rad, rad.
struct RelativePose {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();
};

/// a then b: T_1_2 and T_2_3 give T_1_3, with independent errors (Sola et al., "A micro Lie theory", eq. 54).
RelativePose composed(const RelativePose& a, const RelativePose& b);
RelativePose inverse(const RelativePose& pose);

/// All keyframes in their order, as the odometry joins them. Positions count from 0.
class KeyframeChain {
 public:
  explicit KeyframeChain(const DriftParams& params) : params_(params) {}

  /// Throws std::invalid_argument for an id that is not above the last one, or descriptors that are not of
  /// its corners.
  void add(vision::Keyframe keyframe);

  std::size_t size() const { return links_.size(); }
  const vision::Keyframe& operator[](std::size_t position) const { return links_[position].keyframe; }

  /// Pose of keyframe `to` in keyframe `from` by the odometry, whichever comes first, with what it has
  /// drifted in between; nothing where the odometry began anew between the two.
  std::optional<RelativePose> relative(std::size_t from, std::size_t to) const;
  /// Way between the two along the keyframes, m.
  double way_m(std::size_t from, std::size_t to) const;

  /// Landmarks that both keyframes saw.
  std::size_t sharedLandmarks(std::size_t a, std::size_t b) const;

 private:
  struct Link {
    vision::Keyframe keyframe;
    std::vector<std::uint64_t> landmark_ids;  ///< in increasing order
    std::size_t run = 0;                      ///< number of starts of the odometry before it
    Eigen::Isometry3d T_start_keyframe = Eigen::Isometry3d::Identity();
    Matrix6d covariance_at_start = Matrix6d::Zero();  ///< of the motions since the start, axes of the start
    double way_m = 0.0;
  };

  DriftParams params_;
  std::vector<Link> links_;
};

}  // namespace stereo_nav::mapping
