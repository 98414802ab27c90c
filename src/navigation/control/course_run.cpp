#include "navigation/control/course_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "core/angles.h"
#include "core/statistics.h"

namespace stereo_nav::control {
namespace {

constexpr int kSubsteps = 4;
constexpr double kNearEnd_m = 0.03, kLastPart_m = 0.5;
constexpr double kRest_m_per_s = 1e-3, kRest_rad_per_s = 1e-3;

Eigen::Vector2d referencePoint(const DriveState& state, double reference_m) {
  return state.T_world_base * Eigen::Vector2d(reference_m, 0.0);
}

DriveState atStart(const Path& path, double reference_m) {
  const PathPoint start = path.at(0.0);
  DriveState state;
  state.T_world_base.linear() = Eigen::Rotation2Dd(start.heading_rad).toRotationMatrix();
  state.T_world_base.translation() =
      start.position - state.T_world_base.linear() * Eigen::Vector2d(reference_m, 0.0);
  return state;
}

bool stands(const DriveState& state) {
  return state.twist.head<2>().norm() < kRest_m_per_s && std::abs(state.twist.z()) < kRest_rad_per_s;
}

void summarise(const Path& path, double reference_m, CourseRun& run) {
  double squares = 0.0;
  for (const auto& sample : run.samples) {
    run.worst_m = std::max(run.worst_m, std::abs(sample.left_m));
    squares += sample.left_m * sample.left_m;
  }
  const CourseRun::Sample& end = run.samples.back();
  const PathPoint goal = path.points().back();
  run.rms_m = std::sqrt(squares / static_cast<double>(run.samples.size()));
  run.end_distance_m = (referencePoint(end.state, reference_m) - goal.position).norm();
  run.end_heading_error_rad = std::abs(wrapRadians(end.state.heading_rad() - goal.heading_rad));
  run.duration_s = end.time_s;
}

/// The path's place nearest to the reference point, sought near the last one.
class Nearest {
 public:
  explicit Nearest(const Path& path) : path_(path) {}

  CourseRun::Sample sampleOf(double time_s, const DriveState& state, double reference_m) {
    const Eigen::Vector2d reference = referencePoint(state, reference_m);
    arc_m_ = path_.nearestArc(reference, arc_m_ - 1.0, arc_m_ + 1.0);
    const double distance_m = (reference - path_.at(arc_m_).position).norm();
    return {time_s, state, std::copysign(distance_m, path_.leftOf(reference, arc_m_))};
  }
  /// Whether the last place is near the end, or the end itself. The course may come by the end's place
  /// before.
  bool nearEnd(double left_m) const {
    return arc_m_ >= path_.length_m() || (path_.length_m() - arc_m_ < kLastPart_m && left_m < kNearEnd_m);
  }

 private:
  const Path& path_;
  double arc_m_ = 0.0;
};

/// What the odometry says of the base: some time old, and not exact. The same in every run.
class Odometry {
 public:
  Odometry(const CourseOptions& options, double substep_s)
      : options_(options), age_(static_cast<std::size_t>(std::lround(options.odometry_age_s / substep_s))) {}

  void add(const DriveState& state) { states_.push_back(state); }

  DriveState newest() {
    DriveState state = states_.size() > age_ ? states_[states_.size() - 1 - age_] : states_.front();
    const double x_m = normal_(random_), y_m = normal_(random_), turn = normal_(random_);
    state.T_world_base.translation() += options_.position_noise_m * Eigen::Vector2d(x_m, y_m);
    state.T_world_base.rotate(options_.heading_noise_rad * turn);
    return state;
  }

 private:
  const CourseOptions& options_;
  std::size_t age_;
  std::vector<DriveState> states_;
  std::mt19937 random_{1};
  std::normal_distribution<double> normal_;
};

}  // namespace

CourseRun driveCourse(const Path& path, Follower& follower, const CourseOptions& options) {
  CourseRun run;
  CommandHistory under_way(options.drive);
  Nearest nearest(path);
  DriveState state = atStart(path, options.reference_m);
  std::vector<double> step_s;
  const double substep_s = options.period_s / kSubsteps;
  Odometry odometry(options, substep_s);
  odometry.add(state);
  for (int period = 0; period * options.period_s < options.most_s && !run.finished; ++period) {
    const double now_s = period * options.period_s;
    const auto before = std::chrono::steady_clock::now();
    const Twist command = follower.command(odometry.newest(), now_s - options.odometry_age_s, now_s);
    step_s.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
    under_way.add(now_s, command);
    for (int i = 0; i < kSubsteps && !run.finished; ++i) {
      const double from_s = now_s + i * substep_s;
      state = under_way.predicted(state, from_s, from_s + substep_s);
      odometry.add(state);
      run.samples.push_back(nearest.sampleOf(from_s + substep_s, state, options.reference_m));
      const double left_m =
          (referencePoint(state, options.reference_m) - path.points().back().position).norm();
      run.finished = options.until_near_end ? nearest.nearEnd(left_m) : follower.finished() && stands(state);
    }
  }
  summarise(path, options.reference_m, run);
  run.median_step_s = quantile(step_s, 0.5);
  return run;
}

}  // namespace stereo_nav::control
