#pragma once

#include <Eigen/Core>
#include <optional>

namespace stereo_nav::odometry {

/// A constant error of the right images' stamps, as a driver makes one that stamps one camera when its image
/// arrives and the other one when it is taken. It is found in the rows: where the rig moves, a feature moves
/// through the image, and the right camera sees it in the row of the true time of exposure. What else
/// displaces rows, an error of the calibration, is the same in each frame and linear in the image
/// (vision::EpipolarError) and is estimated together with it, by robust least squares with a fading memory.
/// The columns tell nothing for certain, since the depths go along with them.
class RightStampError {
 public:
  struct Estimate {
    double error_s;  ///< stamp minus true time: positive where the stamps are late
    double sigma_s;  ///< what the lenses displace rows by, otherwise than linearly, included
    /// An error that is beyond doubt and matters.
    bool isCertain() const;
  };

  /// One match: where vision::EpipolarError::basis() has it, how far the right row is below that of the
  /// stamp, and by how much an error of the stamp lowers the row, px/s.
  void add(const Eigen::Vector3d& basis, double error_px, double px_per_s);
  /// Draws the conclusion from the matches added. An error that is certain is taken off from now on, and what
  /// is left of it is estimated anew.
  void learn();
  /// Of the stamps as they come. Nothing until enough matches have been seen.
  std::optional<Estimate> estimate() const;
  /// What is to be taken off the stamps; 0 where no error is certain.
  double takenOff_s() const { return taken_off_s_; }

 private:
  /// Of what has not been taken off yet.
  std::optional<Estimate> rest() const;

  Eigen::Matrix4d information_ = Eigen::Matrix4d::Zero();  ///< of (nod, roll, focal length, time), in matches
  Eigen::Vector4d moments_ = Eigen::Vector4d::Zero();
  Eigen::Vector4d coefficients_ = Eigen::Vector4d::Zero();  ///< px, px, px, s
  double squares_px2_ = 0.0;                                ///< of the errors, weighted
  double taken_off_s_ = 0.0;
};

}  // namespace stereo_nav::odometry
