#pragma once

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/NavSatFix.h>

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "estimation/ekf/fusion_setup.h"

namespace stereo_nav::ros_io {

/// Turns messages into measurements of base_link. A body or sensor elsewhere is moved to base_link by its
/// mounting; its covariance is turned, the lever's part of it left out.
class FusionMessages {
 public:
  /// Pose of a frame in base_link; nothing where it is not known (yet).
  using Mounting = std::function<std::optional<Eigen::Isometry3d>(const std::string& frame)>;

  FusionMessages(const estimation::FusionConfig& config, const estimation::FusionSetup& setup,
                 Mounting mounting);

  /// Measurements of a message of that sensor (its place in FusionConfig::sensors); none where its frame is
  /// not known.
  std::vector<estimation::Measurement> convert(std::size_t sensor, const nav_msgs::Odometry& message);
  std::vector<estimation::Measurement> convert(std::size_t sensor,
                                               const geometry_msgs::PoseWithCovarianceStamped& message);
  std::vector<estimation::Measurement> convert(std::size_t sensor,
                                               const geometry_msgs::TwistWithCovarianceStamped& message);
  std::vector<estimation::Measurement> convert(std::size_t sensor, const sensor_msgs::Imu& message);
  /// East and north are x and y, about the first fix (a plane: 8 cm off at a distance of 1 km).
  std::vector<estimation::Measurement> convert(std::size_t sensor, const sensor_msgs::NavSatFix& message);

  /// Frames without a mounting, and how many messages were left out for each.
  const std::map<std::string, std::size_t>& unknownFrames() const { return unknown_frames_; }
  void reset() { first_pose_.clear(); }

 private:
  std::optional<Eigen::Isometry3d> T_base(const std::string& frame);
  void addPose(std::size_t sensor, double time_s, const Eigen::Isometry3d& T_world_base,
               const Matrix6d& covariance, const std::optional<Matrix6d>& twist_covariance,
               std::vector<estimation::Measurement>& measurements);
  void addTwist(std::size_t sensor, double time_s, const std::string& frame, const Vector6d& twist,
                const Matrix6d& covariance, std::vector<estimation::Measurement>& measurements);

  estimation::FusionConfig config_;
  estimation::FusionSetup setup_;
  Mounting mounting_;
  std::map<std::string, Eigen::Isometry3d> known_frames_;
  std::map<std::string, std::size_t> unknown_frames_;
  std::map<std::size_t, Eigen::Isometry3d> first_pose_;  ///< of sensors with `relative`
  std::map<std::size_t, Eigen::Vector3d> first_fix_;     ///< latitude and longitude in degrees, height in m
};

}  // namespace stereo_nav::ros_io
