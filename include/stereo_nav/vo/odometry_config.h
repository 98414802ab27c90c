#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "stereo_nav/params/parameters.h"
#include "stereo_nav/vo/odometry.h"
#include "stereo_nav/vo/stereo_odometry.h"
#include "stereo_nav/vo/thesis_odometry.h"

namespace stereo_nav::vo {

enum class Method { kStereo, kThesis };

/// All parameters of a run; one section per composition, `method` says which one works.
struct OdometryConfig {
  Method method = Method::kStereo;
  StereoParams stereo;
  ThesisParams thesis;

  void describe(ParameterVisitor& visitor);
};

/// Reads config/vo.yaml or a file like it. Throws ParameterError.
OdometryConfig loadOdometryConfig(const std::string& path);

/// `R_camera_imu` takes coordinates of the IMU frame into the left optical frame.
std::unique_ptr<Odometry> makeOdometry(const OdometryConfig& config, const StereoCalibration& calibration,
                                       const Eigen::Matrix3d& R_camera_imu);

}  // namespace stereo_nav::vo
