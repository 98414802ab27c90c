#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>

namespace stereo_nav::calibration {

/// A rig file that cannot be used; one line that names file and entry, and says what is expected.
class RigFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Rotations about the fixed x, then y, then z axis (REP-103): R = Rz(yaw) Ry(pitch) Rx(roll), in deg.
struct RollPitchYaw {
  double roll_deg = 0.0;   ///< -180 to 180
  double pitch_deg = 0.0;  ///< -90 to 90
  double yaw_deg = 0.0;    ///< -180 to 180

  Eigen::Matrix3d rotation() const;
  static RollPitchYaw of(const Eigen::Matrix3d& R);
};

/// Optical axes (x right, y down, z forward) -> axes of a body that looks along x (y left, z up).
Eigen::Matrix3d opticalToBody();

/// The left camera's rotation in base_link by `mounting/camera` of a rig file: optical frame -> base_link.
/// Throws RigFileError.
Eigen::Matrix3d readCameraRotation(const std::string& rig_yaml, const std::string& source);

/// The text of a rig file with `roll_deg`, `pitch_deg`, `yaw_deg` of `mounting/imu` set to those of
/// `R_base_imu`, to 0.01 deg; everything else, comments too, stays to the byte. Throws RigFileError where
/// the three numbers are not there to be replaced. `source` is what messages call the text.
std::string withImuRotation(const std::string& rig_yaml, const std::string& source,
                            const Eigen::Matrix3d& R_base_imu);

}  // namespace stereo_nav::calibration
