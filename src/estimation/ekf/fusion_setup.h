#pragma once

#include <vector>

#include "estimation/ekf/channel.h"
#include "estimation/ekf/fusion_config.h"
#include "estimation/ekf/fusion_filter.h"

namespace stereo_nav::estimation {

/// The channels of one sensor, -1 where it has none of a kind, and the fields that each takes.
struct SensorChannels {
  int pose = -1;   ///< poses, or their motions
  int twist = -1;  ///< velocities and turn rates, or a gyroscope's
  int acceleration = -1;
  std::vector<int> pose_fields, twist_fields, acceleration_fields;
};

/// What a file makes of the filter.
struct FusionSetup {
  StateParts parts;
  std::vector<Channel> channels;
  std::vector<SensorChannels> sensors;  ///< in the order of FusionConfig::sensors
};

FusionSetup setUp(const FusionConfig& config);

}  // namespace stereo_nav::estimation
