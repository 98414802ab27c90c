#pragma once

#include <string>
#include <vector>

#include "kinematics/twist.h"
#include "ros/driven_rig.h"
#include "sim/driven_simulation.h"
#include "tools/simulate/simulated_bag.h"

namespace stereo_nav::tools {

/// A velocity and when the base receives it.
struct TimedVelocity {
  double time_s = 0.0;
  kinematics::Twist twist = kinematics::Twist::Zero();
};

/// Reads lines of `time_s forward_m_per_s left_m_per_s turn_rad_per_s` in the order of time; `#` begins a
/// comment. Throws InputError that names the file and the line.
std::vector<TimedVelocity> readVelocities(const std::string& path);

/// Drives with these commands and writes all messages in the order of their arrival: up to
/// `options.duration_s`, or else to the last command. Throws InputError when the bag cannot be written.
void writeDrivenBag(const std::string& path, sim::DrivenSimulation& simulation,
                    const ros_io::DrivenDevices& devices, const Eigen::Isometry3d& T_base_imu,
                    const std::vector<TimedVelocity>& commands, const SimulatedBagOptions& options);

}  // namespace stereo_nav::tools
