#pragma once

#include "core/rig_file.h"
#include "ros/base_bridge_params.h"
#include "ros/laser_bridge_params.h"
#include "ros/range_bridge_params.h"
#include "sim/driven_params.h"

namespace stereo_nav::ros_io {

/// The devices that a rig file describes, for a simulated robot that is driven: what moves and measures, and
/// what the messages of each device say.
struct DrivenDevices {
  sim::DrivenRig rig;  ///< its range finders are those of `base`, then those of `finders`
  BaseBridgeParams base;
  LaserBridgeParams laser;
  RangeBridgeParams finders;
};

/// Throws ParameterError, also where the file has no section `drive`. Without the section `laser` or
/// `range_finders` the robot has none.
DrivenDevices readDrivenDevices(const RigFile& rig);

}  // namespace stereo_nav::ros_io
