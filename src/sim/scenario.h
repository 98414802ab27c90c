#pragma once

#include <string>
#include <vector>

#include "sim/camera_clocks.h"
#include "sim/image_sensor.h"
#include "sim/imu_model.h"
#include "sim/scene.h"
#include "sim/trajectory.h"

namespace stereo_nav::sim {

/// Something that happens to the light for a while.
struct Event {
  enum class Kind { kLight, kBlockLeft, kBlockRight, kBlockBoth };
  Kind kind = Kind::kLight;
  double from_s = 0.0;
  double to_s = 1.0;
  double level = 0.0;

  void describe(ParameterVisitor& visitor);
};

/// Where the cameras sit on the robot. They look along base_link's x axis but for the angles, which turn
/// about its fixed axes, roll first, then pitch, then yaw.
struct RigParams {
  int image_scale = 1;
  int samples_per_pixel = 4;
  double camera_x_m = 0.10;
  double camera_y_m = 0.0613;
  double camera_z_m = 0.283;
  double camera_roll_deg = 0.0;
  double camera_pitch_deg = 0.0;
  double camera_yaw_deg = 0.0;

  void describe(ParameterVisitor& visitor);
  /// Of the rectified left optical frame.
  Eigen::Isometry3d T_base_camera() const;
};

/// Everything about a simulated drive except its seed.
struct Scenario {
  SceneParams scene;
  std::vector<PathStep> path;
  std::vector<Event> events;
  MotionParams motion;
  RigParams rig;
  TimingParams timing;
  SensorParams sensor;
  CameraResponse left, right;
  ImuParams imu;

  /// All but the lists.
  void describe(ParameterVisitor& visitor);
};

/// Reads a scenario file: sections as described, and the lists `path`, `objects`, `clutter`, `events`, each
/// item as described by its struct. `overrides` are `section.name=value`, applied on top. Throws
/// ParameterError that names file, item and parameter.
Scenario loadScenario(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace stereo_nav::sim
