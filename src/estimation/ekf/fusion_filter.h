#pragma once

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "estimation/ekf/estimator.h"

namespace stereo_nav::estimation {

/// Pose and velocity of base_link as nav_msgs/Odometry has them.
struct FusedEstimate {
  double time_s = 0.0;
  Eigen::Isometry3d T_world_base = Eigen::Isometry3d::Identity();
  Matrix6d pose_covariance = Matrix6d::Zero();  ///< x y z, then rotation about them; axes of the world
  Vector6d twist = Vector6d::Zero();            ///< m/s, rad/s; axes of base_link
  Matrix6d twist_covariance = Matrix6d::Zero();
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< m/s^2; axes of base_link
};

/// The filter over any number of sensors, whose measurements may come late and in any order. A late one is
/// put where it belongs: the state of then is taken from the history and all measurements since are taken in
/// again, so that the result does not depend on the order of arrival. The history is bounded in time and in
/// bytes.
class FusionFilter {
 public:
  FusionFilter(const FilterParams& params, const StateParts& parts, std::vector<Channel> channels);

  /// A measurement that arrives at `received_s` of the clock of the stamps. One with a stamp more than half a
  /// second later than that is left out. Where `received_s` itself goes back by more than a second, the clock
  /// was set back.
  void add(Measurement measurement, double received_s);

  /// Whether there was a measurement, so that there is a pose.
  bool started() const { return !history_.empty(); }
  /// Of the newest measurement.
  double time_s() const { return history_.back().memory.state.time_s; }
  /// At the newest measurement, or predicted to a later time. Only after started().
  FusedEstimate estimate(double time_s) const;
  const State& state() const { return history_.back().memory.state; }
  const StateLayout& layout() const { return estimator_.layout(); }

  /// Sets the pose at the newest measurement; before the first one, of the start.
  void setPose(const Eigen::Isometry3d& T_world_base, const Matrix6d& covariance);
  /// Begins anew at the initial state.
  void reset();

  const std::vector<Channel>& channels() const { return estimator_.channels(); }
  const std::vector<ChannelStatistics>& statistics() const { return statistics_; }
  /// What the user should know, since the last call; each thing once, and again when it comes back after ten
  /// seconds.
  std::vector<std::string> takeAnnouncements();
  std::size_t historyBytes() const { return history_.size() * entryBytes(); }
  std::size_t clockResets() const { return clock_resets_; }

 private:
  struct Entry {
    Measurement measurement;
    EstimatorMemory memory;  ///< after it
  };

  bool stampUsable(const Measurement& measurement, double received_s);
  void begin(double time_s);
  void clockSetBack(double time_s, double by_s);
  void insert(Measurement taken);
  std::size_t firstLaterThan(double time_s) const;
  void takeInAgain(std::size_t from);
  void report(const Measurement& measurement, const Outcome& outcome);
  void reportVerdict(const Verdict& verdict, double time_s);
  void forgetOld();
  std::size_t entryBytes() const;
  void say(const std::string& key, const std::string& text, double time_s);
  const std::string& nameOf(const Measurement& measurement) const;
  ChannelStatistics& statisticsOf(const Measurement& measurement);

  FilterParams params_;
  Estimator estimator_;
  std::deque<Entry> history_;  ///< in order of time; the first entry is older than what can be rewound
  std::vector<ChannelStatistics> statistics_;
  double received_s_ = 0.0;  ///< of the last measurement
  std::size_t clock_resets_ = 0;
  std::optional<std::pair<Eigen::Isometry3d, Matrix6d>> start_pose_;
  std::map<std::string, double> said_;
  std::vector<std::string> announcements_;
};

}  // namespace stereo_nav::estimation
