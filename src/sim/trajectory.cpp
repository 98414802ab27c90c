#include "sim/trajectory.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "core/roll_pitch_yaw.h"
#include "sim/speed_profile.h"
#include "sim/spline.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::sim {
namespace {

struct PlanarPose {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
  double speed_m_s = 0.0;
};

Eigen::Vector2d directionOf(double heading_rad) {
  return {std::cos(heading_rad), std::sin(heading_rad)};
}

}  // namespace

/// A stretch of motion with its own clock, starting at 0.
class Trajectory::Piece {
 public:
  virtual ~Piece() = default;
  virtual double duration_s() const = 0;
  virtual PlanarPose at(double time_s) const = 0;
};

class Trajectory::Wait : public Piece {
 public:
  Wait(const PlanarPose& where, double duration_s) : where_(where), duration_s_(duration_s) {}
  double duration_s() const override { return duration_s_; }
  PlanarPose at(double) const override { return where_; }

 private:
  PlanarPose where_;
  double duration_s_;
};

/// A turn on the spot, with a sinusoidal yaw rate from 0 to the limit and back.
class Trajectory::Turn : public Piece {
 public:
  Turn(const PlanarPose& start, double angle_rad, double max_rate_rps)
      : start_(start), angle_rad_(angle_rad), duration_s_(2.0 * std::fabs(angle_rad) / max_rate_rps) {}
  double duration_s() const override { return duration_s_; }
  PlanarPose at(double time_s) const override {
    const double share = duration_s_ > 0.0 ? std::clamp(time_s / duration_s_, 0.0, 1.0) : 1.0;
    PlanarPose pose = start_;
    pose.heading_rad += angle_rad_ * (share - std::sin(2.0 * kPi * share) / (2.0 * kPi));
    return pose;
  }

 private:
  PlanarPose start_;
  double angle_rad_;
  double duration_s_;
};

class Trajectory::Drive : public Piece {
 public:
  Drive(const std::vector<Eigen::Vector2d>& points, double heading_rad, const MotionParams& motion)
      : curve_(points, directionOf(heading_rad)),
        profile_(curve_.length_m(), [this](double arc) { return curve_.at(arc).curvature_1pm; },
                 {motion.max_speed_mps, motion.max_acceleration_mps2, motion.max_yaw_rate_dps * kRadPerDeg,
                  motion.speed_variation}) {}
  double duration_s() const override { return profile_.duration_s(); }
  PlanarPose at(double time_s) const override {
    const PlanarSpline::Sample sample = curve_.at(profile_.arc_m(time_s));
    return {sample.position, sample.heading_rad, profile_.speed_m_s(time_s)};
  }
  double timeOfPoint(std::size_t index) const { return profile_.timeOf(curve_.arcOfPoint(index)); }

 private:
  PlanarSpline curve_;
  SpeedProfile profile_;
};

Trajectory::Trajectory(const std::vector<PathStep>& steps, const MotionParams& motion) : motion_(motion) {
  PlanarPose here;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    switch (steps[i].action) {
      case PathStep::Action::kWait:
        append(std::make_unique<Wait>(here, steps[i].duration_s));
        break;
      case PathStep::Action::kTurn:
        append(std::make_unique<Turn>(here, steps[i].angle_deg * kRadPerDeg,
                                      motion.max_yaw_rate_dps * kRadPerDeg));
        break;
      case PathStep::Action::kDriveTo: {
        std::vector<Eigen::Vector2d> points{here.position};
        for (; i < steps.size() && steps[i].action == PathStep::Action::kDriveTo; ++i) {
          points.emplace_back(steps[i].x_m, steps[i].y_m);
        }
        --i;
        auto drive = std::make_unique<Drive>(points, here.heading_rad, motion);
        for (std::size_t k = 1; k < points.size(); ++k) {
          waypoints_.push_back({duration_s_ + drive->timeOfPoint(k), points[k]});
        }
        append(std::move(drive));
        break;
      }
    }
    if (!pieces_.empty()) here = pieces_.back()->at(pieces_.back()->duration_s());
    here.speed_m_s = 0.0;
  }
  if (pieces_.empty()) append(std::make_unique<Wait>(here, 0.0));
}

Trajectory::~Trajectory() = default;
Trajectory::Trajectory(Trajectory&&) noexcept = default;

void Trajectory::append(std::unique_ptr<Piece> piece) {
  starts_s_.push_back(duration_s_);
  duration_s_ += piece->duration_s();
  pieces_.push_back(std::move(piece));
}

Eigen::Isometry3d Trajectory::pose(double time_s) const {
  const auto after = std::upper_bound(starts_s_.begin() + 1, starts_s_.end(), time_s);
  const auto i = static_cast<std::size_t>(after - starts_s_.begin()) - 1;
  const double local_s = std::clamp(time_s - starts_s_[i], 0.0, pieces_[i]->duration_s());
  const PlanarPose planar = pieces_[i]->at(local_s);

  // The sway of an uneven floor grows with the speed.
  const double sway = motion_.sway_deg * kRadPerDeg * planar.speed_m_s / motion_.max_speed_mps;
  const double pitch =
      sway * (0.7 * std::sin(2.0 * kPi * 1.7 * time_s) + 0.3 * std::sin(2.0 * kPi * 4.3 * time_s));
  const double roll =
      sway * (0.7 * std::sin(2.0 * kPi * 1.3 * time_s) + 0.3 * std::sin(2.0 * kPi * 3.7 * time_s));
  Eigen::Isometry3d T_world_base = Eigen::Isometry3d::Identity();
  T_world_base.translation().head<2>() = planar.position;
  T_world_base.linear() = RollPitchYaw{roll, pitch, planar.heading_rad}.rotation();
  return T_world_base;
}

BaseState Trajectory::state(double time_s) const {
  constexpr double kStep_s = 1e-3;
  const Eigen::Isometry3d before = pose(time_s - kStep_s), after = pose(time_s + kStep_s);
  BaseState state;
  state.T_world_base = pose(time_s);
  const Eigen::Matrix3d R_base_world = state.T_world_base.linear().transpose();
  state.velocity_base = R_base_world * (after.translation() - before.translation()) / (2.0 * kStep_s);
  state.angular_velocity_base = logRotation(before.linear().transpose() * after.linear()) / (2.0 * kStep_s);
  state.acceleration_world =
      (after.translation() - 2.0 * state.T_world_base.translation() + before.translation()) /
      (kStep_s * kStep_s);
  return state;
}

void PathStep::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "action", action,
            {{"drive_to", Action::kDriveTo}, {"turn", Action::kTurn}, {"wait", Action::kWait}},
            "what the robot does; neighbouring drive_to are one smooth curve without a stop");
  visitor.real("x_m", x_m, {-100.0, 100.0}, "m", "drive_to: way-point, forward from the start");
  visitor.real("y_m", y_m, {-100.0, 100.0}, "m", "drive_to: way-point, left of the start");
  visitor.real("angle_deg", angle_deg, {-3600.0, 3600.0}, "deg", "turn: on the spot, positive to the left");
  visitor.real("duration_s", duration_s, {0.0, 1e5}, "s", "wait: for how long");
}

void MotionParams::describe(ParameterVisitor& visitor) {
  visitor.real("max_speed_mps", max_speed_mps, {0.01, 10.0}, "m/s", "speed on straight stretches");
  visitor.real("max_acceleration_mps2", max_acceleration_mps2, {0.01, 10.0}, "m/s^2", "along the path");
  visitor.real("max_yaw_rate_dps", max_yaw_rate_dps, {1.0, 360.0}, "deg/s", "slows it down in curves");
  visitor.real("speed_variation", speed_variation, {0.0, 0.9}, "", "share by which the speed wavers");
  visitor.real("sway_deg", sway_deg, {0.0, 10.0}, "deg",
               "roll and pitch at full speed, from an uneven floor");
}

}  // namespace stereo_nav::sim
