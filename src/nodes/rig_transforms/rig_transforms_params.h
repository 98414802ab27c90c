#pragma once

#include <string>

#include "stereo_nav/core/parameter_visitor.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {

/// Parameters of rig_transforms: the names of the frames. Their poses are in the rig file `~rig`.
struct RigTransformsParams {
  std::string base_frame = ros_io::frames::kBase;
  std::string camera_frame = ros_io::frames::kLeftOptical;
  std::string imu_frame = ros_io::frames::kImu;
  std::string laser_frame = ros_io::frames::kLaserLink;

  void describe(ParameterVisitor& visitor) {
    visitor.text("base_frame", base_frame, "frame of the robot, x forward, y left, z up");
    visitor.text("camera_frame", camera_frame, "left optical frame, x right, y down, z forward");
    visitor.text("imu_frame", imu_frame, "frame of the IMU's messages");
    visitor.text("laser_frame", laser_frame, "frame of the scans, where the rig file has a section laser");
  }
};

}  // namespace stereo_nav::nodes
