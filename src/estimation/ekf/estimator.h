#pragma once

#include <array>
#include <optional>
#include <vector>

#include "estimation/ekf/channel.h"
#include "estimation/ekf/filter_params.h"
#include "estimation/ekf/judgement.h"
#include "estimation/ekf/observation.h"

namespace stereo_nav::estimation {

/// All that a measurement changes: what is kept in the history and comes back when it is rewound.
struct EstimatorMemory {
  State state;
  std::vector<ChannelMemory> channels;
  std::array<bool, 6> pose_known{};  ///< fields of the pose that something absolute has measured
  long window = 0;                   ///< bin of the opinions
  double still_since_s = 0.0;
  /// The way by the velocities alone, which corrections of the pose do not move.
  Eigen::Isometry3d T_start_reckoned = Eigen::Isometry3d::Identity();
};

/// What became of one measurement.
struct Outcome {
  enum class Kind { kUsed, kRefused, kAside, kWithoutField, kAnchored } kind = Kind::kUsed;
  double nis = 0.0;
  int fields = 0;
  double information = 0.0;  ///< Innovation::information
  int refused = 0;           ///< of this channel in succession
  double distance = 0.0;     ///< largest residual of a refused measurement: m, rad, m/s, ...
  Verdict verdict;           ///< of the window that it has ended
};

/// The filter without its history: an extended Kalman filter with the error on the manifold (Sola 2017,
/// "Quaternion kinematics for the error-state Kalman filter"), odometries as motions of cloned poses
/// (Roumeliotis and Burdick 2002, "Stochastic cloning").
class Estimator {
 public:
  Estimator(const FilterParams& params, const StateParts& parts, std::vector<Channel> channels);

  const StateLayout& layout() const { return layout_; }
  const std::vector<Channel>& channels() const { return channels_; }
  const ProcessNoise& noise() const { return noise_; }

  /// The state at the start, of that time.
  EstimatorMemory initial(double time_s) const;
  /// Moves `memory` on to the measurement, which must not be older, and takes it in.
  Outcome apply(const Measurement& measurement, EstimatorMemory& memory) const;
  /// Sets the pose with its covariance (axes of the world); the odometries go on from there.
  void setPose(const Eigen::Isometry3d& T_world_base, const Matrix6d& covariance,
               EstimatorMemory& memory) const;

 private:
  Verdict voteWhenDue(double time_s, EstimatorMemory& memory) const;
  Outcome applyMotion(const Measurement& measurement, EstimatorMemory& memory) const;
  Outcome applyDirect(const Measurement& measurement, EstimatorMemory& memory) const;
  void holdUnshownScales(double time_s, EstimatorMemory& memory) const;
  Outcome takeIn(const Measurement& measurement, Innovation innovation, EstimatorMemory& memory) const;
  void openUnknownPose(const Measurement& measurement, EstimatorMemory& memory) const;
  void startAnchor(const Measurement& measurement, EstimatorMemory& memory) const;
  void holdStill(const Measurement& measurement, EstimatorMemory& memory) const;

  FilterParams params_;
  StateLayout layout_;
  ProcessNoise noise_;
  std::vector<Channel> channels_;
  std::vector<int> anchor_of_;  ///< of each channel; -1: none
  Gate gate_;
};

}  // namespace stereo_nav::estimation
