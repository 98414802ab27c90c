#include "stereo_nav/odometry/method/odometry_config.h"

#include "odometry/stereo/stereo_odometry.h"
#include "odometry/thesis/thesis_odometry.h"

namespace stereo_nav::odometry {

struct OdometryConfig::Sections {
  Method method = Method::kStereo;
  StereoParams stereo;
  ThesisParams thesis;
};

OdometryConfig::OdometryConfig() : sections_(std::make_unique<Sections>()) {}
OdometryConfig::OdometryConfig(const OdometryConfig& other)
    : sections_(std::make_unique<Sections>(*other.sections_)) {}
OdometryConfig& OdometryConfig::operator=(const OdometryConfig& other) {
  *sections_ = *other.sections_;
  return *this;
}
OdometryConfig::~OdometryConfig() = default;

Method OdometryConfig::method() const {
  return sections_->method;
}

DisparityUse OdometryConfig::disparityUse() const {
  return sections_->method == Method::kStereo ? DisparityUse::kNone : sections_->thesis.disparity;
}

void OdometryConfig::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "method", sections_->method, {{"stereo", Method::kStereo}, {"thesis", Method::kThesis}},
            "which composition of the stages runs");
  visitSection(visitor, "stereo", sections_->stereo);
  visitSection(visitor, "thesis", sections_->thesis);
}

OdometryConfig loadOdometryConfig(const std::string& path) {
  OdometryConfig config;
  readParameters(loadYamlFile(path), path, config);
  return config;
}

std::unique_ptr<Odometry> makeOdometry(const OdometryConfig& config,
                                       const vision::StereoCalibration& calibration,
                                       const Eigen::Matrix3d& R_camera_imu) {
  if (config.method() == Method::kStereo) {
    return std::make_unique<StereoOdometry>(config.sections_->stereo, calibration, R_camera_imu);
  }
  return std::make_unique<ThesisOdometry>(config.sections_->thesis, calibration, R_camera_imu);
}

}  // namespace stereo_nav::odometry
