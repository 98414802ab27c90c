#pragma once

#include <string>
#include <vector>

#include "core/rig_file.h"
#include "sim/calibration_error.h"
#include "sim/camera_clocks.h"
#include "sim/driven_params.h"
#include "sim/image_sensor.h"
#include "sim/imu_model.h"
#include "sim/map_walls.h"
#include "sim/scene.h"
#include "sim/trajectory.h"
#include "sim/wheel_model.h"

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

/// Where the cameras sit on the robot, and how finely they are rendered.
struct RigParams {
  int image_scale = 1;
  int samples_per_pixel = 4;
  SensorMounting camera{0.10, 0.0613, 0.283, 0.0, 0.0, 0.0};  ///< the left one

  void describe(ParameterVisitor& visitor);
  /// Pose of the rectified left optical frame.
  Eigen::Isometry3d T_base_camera() const { return camera.T_base_optical(); }
};

/// Everything about a simulated drive except its seed.
struct Scenario {
  SceneParams scene;
  MapWallsParams map_walls;  ///< loadScenario() has raised them among the scene's objects
  std::vector<PathStep> path;
  std::vector<Event> events;
  MotionParams motion;
  RigParams rig;
  CalibrationErrorParams calibration_error;
  TimingParams timing;
  SensorParams sensor;
  CameraResponse left, right;
  ImuParams imu;
  WheelModelParams wheels;
  DrivenParams driven;
  LaserModelParams laser;
  RangeModelParams range;
  kinematics::DriveParams drive;  ///< nominal wheels, of the rig file; none: no wheels are simulated

  /// All but the lists and the drive.
  void describe(ParameterVisitor& visitor);
};

/// Reads a scenario file: sections as described, and the lists `path`, `objects`, `clutter`, `events`, each
/// item as described by its struct. `extends: FILE` (beside this one, or a list) begins with what those hold:
/// lists go on, parameters and the path of this file count. `overrides` are `section.name=value`, applied on
/// top; `sensor.preset` takes the place of all that was set before it in the sections sensor,
/// left and right; what stands beside it or comes later changes single values. Throws ParameterError that
/// names file, item and parameter.
Scenario loadScenario(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace stereo_nav::sim
