#pragma once

#include <yaml-cpp/yaml.h>

#include <array>
#include <string>
#include <vector>

#include "estimation/ekf/fusion_params.h"

namespace stereo_nav::estimation {

/// The inputs that a file of robot_localization may name, and NavSatFix.
enum class SensorType { kOdometry, kPose, kTwist, kImu, kFix };

/// One input.
struct SensorConfig {
  SensorType type = SensorType::kOdometry;
  std::string name;  ///< `odom0`
  std::string topic;
  /// x y z, roll pitch yaw, vx vy vz, vroll vpitch vyaw, ax ay az.
  std::array<bool, 15> use{};
  FusedSensorParams params;
};

/// A whole file.
struct FusionConfig {
  FusionParams params;
  std::vector<SensorConfig> sensors;  ///< in the order of their names
  std::vector<std::string>
      notes;  ///< what means something else here than in robot_localization, one line each
};

/// Reads a parameter file of robot_localization's ekf_localization_node, or one of ours. Throws
/// ParameterError for unknown names, lists of a wrong length and values out of range; what robot_localization
/// has and this filter does not is named in the notes, with the reason.
FusionConfig readFusionConfig(const YAML::Node& file, const std::string& source);

}  // namespace stereo_nav::estimation
