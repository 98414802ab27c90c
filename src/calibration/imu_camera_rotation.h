#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <string>
#include <vector>

#include "stereo_nav/core/imu_sample.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::calibration {

/// The orientation of the camera at the time of an image, from vision alone.
struct CameraOrientation {
  double time_s;
  Eigen::Matrix3d R_start_camera;
  int run = 0;  ///< orientations of different runs (the vision lost its way in between) are not comparable
};

struct ImuCameraRotationParams {
  double interval_s = 0.25;         ///< over which turns are compared
  double max_offset_s = 0.3;        ///< of the IMU's stamps that is looked for
  double min_rate_deg_s = 3.0;      ///< RMS rate about the second axis of the motion
  double max_sigma_deg = 0.5;       ///< of the result, about its worst axis
  double max_residual_share = 0.2;  ///< RMS disagreement / RMS turn
  int min_turns = 20;

  void describe(ParameterVisitor& visitor);
};

/// The rotation between IMU and camera, from turns of the rig that both have measured.
struct ImuCameraRotation {
  Eigen::Matrix3d R_camera_imu = Eigen::Matrix3d::Identity();  ///< IMU frame -> left optical frame
  Eigen::Vector3d sigma_rad = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  ///< of small turns of R_camera_imu about the camera's axes; what is wrong in the same way all the time
  ///< (axes of the gyroscope that are not square, its scale, the rectification) is not in it
  double imu_offset_s = 0.0;  ///< constant error of the IMU's stamps against the images': > 0 is late
  double imu_offset_sigma_s = std::numeric_limits<double>::infinity();
  Eigen::Vector3d bias_rad_s = Eigen::Vector3d::Zero();  ///< of the IMU's rates, IMU frame
  Eigen::Vector3d rate_rms_rad_s =
      Eigen::Vector3d::Zero();  ///< of the camera about its motion's own axes, largest first
  Eigen::Matrix3d motion_axes = Eigen::Matrix3d::Identity();  ///< those axes as columns, camera frame
  double residual_rms_rad = 0.0;  ///< between the two turns over one interval, outliers down-weighted
  double turn_rms_rad = 0.0;      ///< size of those turns
  std::size_t turns = 0;
  std::string refusal;  ///< empty: usable; else what was seen, the likely cause, the remedy
  bool usable() const { return refusal.empty(); }
};

/// Turns of the camera over successive intervals against those of the IMU: a turn has the same angle in both
/// frames and its axis is rotated by R_camera_imu (Park and Martin, "Robot sensor calibration: solving AX=XB
/// on the Euclidean group", 1994, for the rotation part; a Wahba problem, solved by SVD, Markley 1988). The
/// offset of the stamps is searched for on a grid with the closed form, then rotation, bias and offset are
/// refined together (Gauss-Newton with a Cauchy loss), which also gives the uncertainty. The attitudes of the
/// samples are used if they have any, otherwise the angular rates, as in the odometry. Never throws for poor
/// data: `refusal` says what is wrong with it.
ImuCameraRotation calibrateImuCameraRotation(const std::vector<CameraOrientation>& camera,
                                             const std::vector<ImuSample>& imu,
                                             const ImuCameraRotationParams& params = {});

}  // namespace stereo_nav::calibration
