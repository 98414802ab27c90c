#pragma once

#include <array>
#include <limits>
#include <string>

#include "estimation/ekf/measurement.h"

namespace stereo_nav::estimation {

/// A kind of measurement of one sensor, as the filter is told of it before the first one.
struct Channel {
  std::string name;  ///< for messages, e.g. `odom0 (wheel/odom)`
  Measurement::Kind kind = Measurement::Kind::kTwist;
  bool wheels = false;        ///< the wheel scales are its
  bool feels_gravity = true;  ///< kAcceleration: false where its driver has taken gravity off
  double gate = 0.0;          ///< Mahalanobis distance beyond which it is refused; 0: by gate_share
  double reading_sigma_m =
      0.005;  ///< kMotion: noise of a single pose, which does not add up from pose to pose
  double reading_sigma_rad = 0.002;  ///< likewise of its rotation
};

/// What a channel says about a velocity or turn rate beyond what the filter expects, summed over a time.
struct Opinion {
  float sum = 0.0F;
  float variance_sum = 0.0F;
  /// Variance of what all of its measurements are off by alike: a gyroscope's bias, the scales of wheels.
  float common_variance = 0.0F;
  float duration_s = 0.0F;  ///< of the motions of an odometry
  int count = 0;

  void add(const Opinion& other);
};

/// Opinions of half a second about the six fields, in bins of a tenth.
struct Opinions {
  static constexpr double kBin_s = 0.1;
  static constexpr int kBins = 5;
  std::array<std::array<Opinion, 6>, kBins> bins{};

  std::array<Opinion, 6>& bin(long index) { return bins[static_cast<std::size_t>(index % kBins)]; }
  Opinion of(std::size_t field) const;
};

/// Of one field of a channel, while it contradicts another one about it and nobody knows who is right.
struct Doubt {
  double factor = 1.0;  ///< of its variance
  double until_s = -std::numeric_limits<double>::infinity();
};

/// What the filter remembers of a channel. Goes back with the state when the history is rewound.
struct ChannelMemory {
  static constexpr double kNever = -std::numeric_limits<double>::infinity();
  double newest_s = kNever;
  double used_s = kNever;  ///< of the last that was taken in
  // Of an odometry: its last pose.
  bool anchored = false;
  double anchored_s = kNever;
  Eigen::Isometry3d T_odometry_base = Eigen::Isometry3d::Identity();
  Matrix6d odometry_covariance = Matrix6d::Zero();
  Eigen::Isometry3d T_start_reckoned =
      Eigen::Isometry3d::Identity();  ///< EstimatorMemory::T_start_reckoned of then
  // How far it is believed.
  double noise_factor = 1.0;      ///< its variances are so much larger than it says
  double aside_until_s = kNever;  ///< outvoted
  std::array<Doubt, 6> doubts;    ///< of each field
  int refused = 0;                ///< by the gate, in succession
  /// The twist that it tells of, smoothed with its sign, so that noise does not look like motion.
  Vector6d smooth_twist = Vector6d::Constant(1.0);
  bool tells_way = true;  ///< its last one told the speed, by its own covariance
  Opinions opinions;
};

/// What became of a channel's measurements.
struct ChannelStatistics {
  std::size_t used = 0;
  std::size_t refused = 0;        ///< by the gate
  std::size_t aside = 0;          ///< while outvoted
  std::size_t without_field = 0;  ///< no field could be used
  std::size_t too_late = 0;
  std::size_t ahead = 0;    ///< stamped later than received
  std::size_t rewound = 0;  ///< late, and put where they belong
  double nis_sum = 0.0;     ///< of those used, by the noise that the channel states
  double nis_fields = 0.0;  ///< fields of those
  /// Share of the variance before that remained after, as the natural logarithm summed over all used: minus
  /// this is the information in nats that the filter took from the channel.
  double information = 0.0;
};

}  // namespace stereo_nav::estimation
