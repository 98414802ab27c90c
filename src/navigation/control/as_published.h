#pragma once

#include <optional>
#include <vector>

#include "navigation/control/follower.h"
#include "navigation/control/path.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::control {

// The followers and the speed loop as their authors wrote them, with what they lack: no speed profile, no
// braking, no compensation of latency. They are there to be compared with.

/// Pursuit of the swerve robot of 2024. Its base moves straight to a point of the path.
struct PublishedPursuitParams {
  double speed_m_per_s = 1.0;
  double look_ahead_gain_s = 0.1;  ///< k of Lf = k v + Lfc
  double look_ahead_m = 0.2;       ///< Lfc
};

/// The index of the nearest point moves forward only; from there on the first point whose straight distance
/// exceeds Lf is chased at constant speed. Cuts corners, since the distance is not measured along the path.
class PublishedPursuit : public Follower {
 public:
  PublishedPursuit(const Path& path, const PublishedPursuitParams& params) : path_(path), params_(params) {}

  Twist command(const DriveState& state, double stamp_s, double now_s) override;
  bool finished() const override { return finished_; }

 private:
  Path path_;
  PublishedPursuitParams params_;
  std::size_t nearest_ = 0;
  bool finished_ = false;
};

/// Stanley of the work on visual SLAM: delta = psi + atan(k e / v), limited; constant speed.
struct PublishedStanleyParams {
  double speed_m_per_s = 1.0;
  double gain_per_s = 2.0;
  double max_steering_deg = 40.0;
  double wheelbase_m = 0.5;
};

/// e is that of the front axle, v the speed that was measured.
class PublishedStanley : public Follower {
 public:
  PublishedStanley(const Path& path, const PublishedStanleyParams& params) : path_(path), params_(params) {}

  Twist command(const DriveState& state, double stamp_s, double now_s) override;
  bool finished() const override { return finished_; }

 private:
  Path path_;
  PublishedStanleyParams params_;
  double arc_m_ = 0.0;
  bool finished_ = false;
};

/// Speed loop of the swerve robot of 2024, in mm/s. Its gains are not published; with these it overshoots on
/// the drive of docs/driving.md by as much as it was measured to do.
struct PublishedPidParams {
  double proportional = 0.1;
  double integral_per_s = 0.1;
  double derivative_s = 0.002;
  double max_term = 300.0;  ///< of each of the three terms
  double min_output = 100.0;
  double max_output = 1000.0;
};

/// The output is a sum of what a PID with an integral of its own puts out (so that the error is integrated
/// twice), the derivative has the wrong sign, the integral is zeroed when the error changes its sign, and the
/// output never falls below `min_output`: this loop does not stop.
class PublishedPid {
 public:
  explicit PublishedPid(const PublishedPidParams& params) : params_(params) {}

  /// One period: the output, within its limits.
  double update(double wanted, double measured, double period_s);

 private:
  PublishedPidParams params_;
  double output_ = 0.0;
  double integral_ = 0.0;
  std::optional<double> last_error_;
};

}  // namespace stereo_nav::control
