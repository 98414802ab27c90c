#include "stereo_nav/vo/odometry_config.h"

namespace stereo_nav::vo {

void OdometryConfig::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "method", method, {{"stereo", Method::kStereo}, {"thesis", Method::kThesis}},
            "which composition of the stages runs");
  visitSection(visitor, "stereo", stereo);
  visitSection(visitor, "thesis", thesis);
}

OdometryConfig loadOdometryConfig(const std::string& path) {
  OdometryConfig config;
  readParameters(loadYamlFile(path), path, config);
  return config;
}

std::unique_ptr<Odometry> makeOdometry(const OdometryConfig& config, const StereoCalibration& calibration,
                                       const Eigen::Matrix3d& R_camera_imu) {
  if (config.method == Method::kStereo) {
    return std::make_unique<StereoOdometry>(config.stereo, calibration, R_camera_imu);
  }
  return std::make_unique<ThesisOdometry>(config.thesis, calibration, R_camera_imu);
}

}  // namespace stereo_nav::vo
