#pragma once

#include <ros/time.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace stereo_nav::tools {

/// Stamps of a `timestamps.txt`, one a line: "2011-09-26 13:02:25.594360375", taken as UTC. Throws InputError
/// that names the line.
std::vector<ros::Time> readDates(const std::string& path);

/// The `count` numbers of the line `name:` of a calib_*.txt. Throws InputError.
std::vector<double> calibrationRow(const std::string& path, const std::string& name, std::size_t count);

/// The lines `R:` and `T:` of a calib_*_to_*.txt: a rigid motion. Throws InputError.
Eigen::Isometry3d readMotion(const std::string& path);

/// One file of `oxts/data`: pose and rates of the inertial unit, x forward, y left, z up.
struct OxtsReading {
  ros::Time stamp;
  Eigen::Isometry3d T_world_imu;        ///< x east, y north, z up, m; see readOxts()
  Eigen::Vector3d angular_velocity;     ///< rad/s, in the unit's axes
  Eigen::Vector3d linear_acceleration;  ///< m/s^2, in the unit's axes
};

/// All readings of `DIR/timestamps.txt` and `DIR/data`. Positions are those of the Mercator projection with
/// the scale of the first latitude (Geiger et al., Vision meets robotics: the KITTI dataset, 2013, and its
/// development kit), less the first one. Readings that are missing or not later than the one before are left
/// out and counted in `left_out`. Throws InputError.
std::vector<OxtsReading> readOxts(const std::string& folder, std::size_t& left_out);

}  // namespace stereo_nav::tools
