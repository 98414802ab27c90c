#pragma once

#include <string>
#include <vector>

#include "estimation/ekf/fusion_setup.h"
#include "ros/recorded_robot.h"
#include "tools/fuse/fuse_options.h"

namespace stereo_nav::tools {

/// A measurement with the time at which the recorder got its message.
struct ReceivedMeasurement {
  double received_s;
  estimation::Measurement measurement;
};

/// What a recording holds for the sensors of a file.
struct FusionInput {
  std::vector<ReceivedMeasurement> measurements;  ///< in the order of receipt
  std::vector<std::string> notes;
};

/// Reads the topics of all sensors. A sensor on laser/odom is computed from the scans where the bag has no
/// such topic. Throws InputError where none of the sensors has a topic in the bag.
FusionInput readFusionInput(const FuseOptions& options, const ros_io::RecordedRobot& robot,
                            const estimation::FusionConfig& config, const estimation::FusionSetup& setup);

}  // namespace stereo_nav::tools
