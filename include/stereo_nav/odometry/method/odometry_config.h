#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "stereo_nav/core/parameters.h"
#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::odometry {

/// Which composition of the stages runs: the package's own default, or the one that the thesis published.
enum class Method { kStereo, kThesis };

/// All parameters of a visual odometry as a configuration file holds them: `method`, and one section for each
/// composition (config/vo.yaml, docs/parameters.md).
class OdometryConfig {
 public:
  OdometryConfig();
  /// A copy of all sections.
  OdometryConfig(const OdometryConfig& other);
  /// Takes over all sections.
  OdometryConfig& operator=(const OdometryConfig& other);
  ~OdometryConfig();

  /// The composition that makeOdometry() makes.
  Method method() const;
  /// The disparity map that this composition wants.
  DisparityUse disparityUse() const;

  /// Names, ranges and meanings of the parameters.
  void describe(ParameterVisitor& visitor);

 private:
  friend std::unique_ptr<Odometry> makeOdometry(const OdometryConfig& config,
                                                const vision::StereoCalibration& calibration,
                                                const Eigen::Matrix3d& R_camera_imu);
  struct Sections;
  std::unique_ptr<Sections> sections_;
};

/// Reads config/vo.yaml or a file like it. Throws ParameterError.
OdometryConfig loadOdometryConfig(const std::string& path);

/// `R_camera_imu` takes coordinates of the IMU frame into the left optical frame.
std::unique_ptr<Odometry> makeOdometry(const OdometryConfig& config,
                                       const vision::StereoCalibration& calibration,
                                       const Eigen::Matrix3d& R_camera_imu);

}  // namespace stereo_nav::odometry
