#pragma once

#include "stereo_nav/core/lie.h"
#include "vision/stereo_view.h"

namespace stereo_nav::vision {

/// Cheap cameras read the rows of an image one after another, top to bottom, over a readout time; the stamp
/// is that of the middle row. What is seen in a row is moved to where it would have been seen at the stamp,
/// along the rig's twist. A global shutter has no readout time, and nothing is changed.
///
/// `twist` is that of the world in the left camera's frame at the stamp, m/s and rad/s.
class RollingShutter {
 public:
  explicit RollingShutter(const StereoCalibration& calibration) : calibration_(calibration) {}

  /// Sets the readout time of the following images: from the first to the last row of the raw image, s.
  void setReadout(double readout_s) { readout_s_ = readout_s; }
  bool isGlobal() const { return readout_s_ == 0.0; }
  /// When the row of a pixel of the rectified image was taken, seconds after the stamp.
  double leftTime_s(const Eigen::Vector2d& left_px) const {
    return time_s(calibration_.left_raw_rows, left_px);
  }
  double rightTime_s(const Eigen::Vector2d& right_px) const {
    return time_s(calibration_.right_raw_rows, right_px);
  }

  /// The place where the left image shows the point `p_camera` (at the stamp), which a global shutter would
  /// show at `px`.
  Eigen::Vector2d seenLeft(const Eigen::Vector2d& px, const Eigen::Vector3d& p_camera,
                           const Vector6d& twist) const;
  /// The observation that a global shutter would have made.
  StereoObservation atStamp(const StereoObservation& seen, const Eigen::Vector3d& p_camera,
                            const Eigen::Isometry3d& T_late_camera, const Vector6d& twist) const;
  /// (x/z, y/z, 1/z) at the stamp of a point that is seen at `left_px` with this 1/depth (1/m, may be 0) in
  /// its row's own time.
  Eigen::Vector3d rayDepthAtStamp(const Eigen::Vector2d& left_px, double inverse_depth,
                                  const Vector6d& twist) const;

 private:
  double time_s(const cv::Mat& raw_rows, const Eigen::Vector2d& px) const;

  StereoCalibration calibration_;
  double readout_s_ = 0.0;
};

}  // namespace stereo_nav::vision
