#pragma once

#include <memory>
#include <optional>
#include <string>

#include "navigation/control/follow_laws.h"
#include "navigation/control/follower.h"
#include "navigation/control/goal_approach.h"
#include "navigation/control/speed_profile.h"

namespace stereo_nav::control {

/// Which law steers: by what the drive can do.
enum class FollowLaw { kHolonomic, kPursuit, kStanley };

/// Where a holonomic base looks while it follows a path.
enum class HeadingMode {
  kAlongPath,    ///< where it goes, which is where its cameras see
  kTowardsGoal,  ///< it turns steadily from the heading at the start to that of the goal
};

/// Everything about driving along a path.
struct ControlParams {
  FollowLaw law = FollowLaw::kPursuit;
  HeadingMode heading = HeadingMode::kAlongPath;
  double period_s = 0.02;
  DriveModelParams drive;
  SpeedLimits speed;
  HolonomicParams holonomic;
  PursuitParams pursuit;
  StanleyParams stanley;
  GoalParams goal;

  /// The point that follows the path, m ahead of base_link: the front axle with Stanley's law, else
  /// base_link.
  double reference_m() const { return law == FollowLaw::kStanley ? drive.wheelbase_m : 0.0; }
  void describe(ParameterVisitor& visitor);
};

/// What a PathDriver does.
enum class DrivePhase {
  kTurningToPath,  ///< on the spot, until it looks along the path
  kFollowing,
  kTurningToGoal,  ///< on the spot, to the heading of the goal
  kArrived,        ///< stands at the goal, for good
  kMissed,         ///< stands where the path ends, but not within the tolerance of the goal
};

/// In words, for the status.
std::string nameOf(DrivePhase phase);

/// Drives a base along a path to its end and to a heading there.
class PathDriver : public Follower {
 public:
  /// `goal_heading_rad`: without one the base ends with the heading of the path. A steered vehicle cannot
  /// turn on the spot and keeps the one it arrives with. `wheels`: to slow down where a wheel could not
  /// follow.
  PathDriver(const ControlParams& params, const Path& path,
             const std::optional<double>& goal_heading_rad = std::nullopt,
             const std::optional<WheelSpeedLimit>& wheels = std::nullopt);

  Twist command(const DriveState& state, double stamp_s, double now_s) override;
  bool finished() const override { return phase() == DrivePhase::kArrived || phase() == DrivePhase::kMissed; }

  /// Drives no faster than this from the next command on.
  void limitSpeed(double most_m_per_s) { most_m_per_s_ = most_m_per_s; }
  /// What the base was given at `now_s` in place of the last command, or without one: somebody else had to
  /// slow it down or stop it.
  void wasGiven(const Twist& twist, double now_s);
  /// The frame of the path has jumped: poses are given in the new one from now on, and the path stays where
  /// it was in the world: `T_new_old` takes its coordinates there.
  void reanchor(const Eigen::Isometry2d& T_new_old);

  DrivePhase phase() const { return phase_.value_or(DrivePhase::kFollowing); }
  double arc_m() const { return arc_m_; }
  const Path& path() const { return path_; }

 private:
  bool canTurnOnSpot() const { return !params_.drive.steered(); }
  double headingError(const DriveState& state, double heading_rad) const;
  void start(const DriveState& state);
  void advancePhase(const DriveState& state);
  void endPath(const DriveState& state, double distance_m);
  Twist twistOf(const DriveState& state);
  Twist followingTwist(const DriveState& state);
  Twist turningTwist(const DriveState& state, double heading_rad);
  Twist endTwist(const DriveState& state);
  /// Wanted heading of a holonomic base, and its change along the path.
  double wantedHeading(double arc_m) const;
  double wantedTurning(double arc_m) const;

  ControlParams params_;
  Path path_;
  PathSpeedProfile profile_;
  SpeedGovernor governor_, turn_governor_;
  CommandHistory history_;
  GoalCheck goal_check_;
  double goal_heading_rad_;
  double start_heading_rad_ = 0.0;
  double most_m_per_s_;
  double arc_m_ = 0.0;
  std::optional<DrivePhase> phase_;  ///< nothing before the first command
};

}  // namespace stereo_nav::control
