#include "kinematics/layouts.h"

#include <cmath>

#include "core/angles.h"

namespace stereo_nav::kinematics {
namespace {

WheelParams wheel(const std::string& name, WheelKind kind, double x_m, double y_m, double radius_m) {
  WheelParams params;
  params.name = name;
  params.kind = kind;
  params.x_m = x_m;
  params.y_m = y_m;
  params.radius_m = radius_m;
  return params;
}

}  // namespace

DriveParams differentialDrive(double track_width_m, double radius_m) {
  return {{wheel("left", WheelKind::kFixed, 0.0, 0.5 * track_width_m, radius_m),
           wheel("right", WheelKind::kFixed, 0.0, -0.5 * track_width_m, radius_m)}};
}

DriveParams mecanumDrive(double half_length_m, double half_width_m, double radius_m) {
  const auto roller = WheelKind::kRollers;
  DriveParams drive{{wheel("front_left", roller, half_length_m, half_width_m, radius_m),
                     wheel("front_right", roller, half_length_m, -half_width_m, radius_m),
                     wheel("rear_left", roller, -half_length_m, half_width_m, radius_m),
                     wheel("rear_right", roller, -half_length_m, -half_width_m, radius_m)}};
  for (auto& each : drive.wheels) each.roller_deg = each.x_m * each.y_m > 0.0 ? -45.0 : 45.0;
  return drive;
}

DriveParams omniDrive(int count, double circle_radius_m, double first_deg, double radius_m) {
  DriveParams drive;
  for (int i = 0; i < count; ++i) {
    const double place_deg = first_deg + 360.0 * i / count;
    drive.wheels.push_back(wheel("wheel_" + std::to_string(i + 1), WheelKind::kRollers,
                                 circle_radius_m * std::cos(kRadPerDeg * place_deg),
                                 circle_radius_m * std::sin(kRadPerDeg * place_deg), radius_m));
    drive.wheels.back().direction_deg = wrapDegrees(place_deg + 90.0);
  }
  return drive;
}

DriveParams deadWheels(double track_width_m, double forward_offset_m, double radius_m) {
  DriveParams drive{{wheel("left", WheelKind::kRollers, 0.0, 0.5 * track_width_m, radius_m),
                     wheel("right", WheelKind::kRollers, 0.0, -0.5 * track_width_m, radius_m),
                     wheel("across", WheelKind::kRollers, forward_offset_m, 0.0, radius_m)}};
  drive.wheels.back().direction_deg = 90.0;
  return drive;
}

DriveParams swerveDrive(const std::vector<Eigen::Vector2d>& modules, double radius_m) {
  DriveParams drive;
  for (const auto& module : modules) {
    drive.wheels.push_back(wheel("module_" + std::to_string(drive.wheels.size() + 1), WheelKind::kSteered,
                                 module.x(), module.y(), radius_m));
  }
  return drive;
}

DriveParams ackermannDrive(double wheelbase_m, double track_width_m, double max_steering_deg,
                           double radius_m) {
  const double y_m = 0.5 * track_width_m;
  DriveParams drive{{wheel("front_left", WheelKind::kSteered, wheelbase_m, y_m, radius_m),
                     wheel("front_right", WheelKind::kSteered, wheelbase_m, -y_m, radius_m),
                     wheel("rear_left", WheelKind::kFixed, 0.0, y_m, radius_m),
                     wheel("rear_right", WheelKind::kFixed, 0.0, -y_m, radius_m)}};
  drive.wheels[0].max_steering_deg = max_steering_deg;
  drive.wheels[1].max_steering_deg = max_steering_deg;
  return drive;
}

}  // namespace stereo_nav::kinematics
