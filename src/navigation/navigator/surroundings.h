#pragma once

#include <Eigen/Core>

namespace stereo_nav::navigator {

/// What is known of a place on the floor.
enum class Place {
  kFree,      ///< seen, now or before, and nothing stood there
  kOccupied,  ///< something stands there
  kUnseen,    ///< nothing is known
};

/// What the cameras and the laser see around the base: the local grid.
class Surroundings {
 public:
  virtual ~Surroundings() = default;

  /// `p_odom`: in the frame in which the base drives.
  virtual Place at(const Eigen::Vector2d& p_odom) const = 0;
};

}  // namespace stereo_nav::navigator
