#pragma once

#include <vector>

#include "kinematics/drive_params.h"

namespace stereo_nav::kinematics {

/// Two plain wheels on one axle through base_link: left, right.
DriveParams differentialDrive(double track_width_m, double radius_m);

/// Four mecanum wheels: front_left, front_right, rear_left, rear_right. Seen from above their rollers form an
/// X, so that the wheels at (half_length, half_width) and opposite turn backwards when the base moves left.
DriveParams mecanumDrive(double half_length_m, double half_width_m, double radius_m);

/// `count` omni wheels on a circle, wheel i at first_deg + i 360/count, each rolling counterclockwise along
/// it.
DriveParams omniDrive(int count, double circle_radius_m, double first_deg, double radius_m);

/// Three passive wheels: left and right roll forward, `across` rolls left at x = forward_offset.
DriveParams deadWheels(double track_width_m, double forward_offset_m, double radius_m);

/// Modules at the given contact points (m, base_link), any number from two.
DriveParams swerveDrive(const std::vector<Eigen::Vector2d>& modules, double radius_m);

/// Four plain wheels, the front ones steered; base_link is in the middle of the rear axle.
DriveParams ackermannDrive(double wheelbase_m, double track_width_m, double max_steering_deg,
                           double radius_m);

}  // namespace stereo_nav::kinematics
