#include "ros/capture_setup.h"

#include <sstream>

namespace stereo_nav::ros_io {
namespace {

const std::string kControls = "controls";

/// Appends the settings of a map; a later setting of a control overrides an earlier one.
void addControls(const YAML::Node& map, const std::string& source,
                 std::vector<camera::ControlSetting>& settings) {
  if (!map.IsDefined() || map.IsNull()) return;
  if (!map.IsMap()) throw ParameterError(source + " must be a list of `name: value` lines");
  for (const auto& entry : map) {
    const auto control = entry.first.as<std::string>();
    try {
      // In YAML, switches are often written as true and false.
      const auto value = entry.second.as<std::string>();
      const bool is_bool = value == "true" || value == "false";
      camera::setIn(settings,
                    {control, is_bool ? static_cast<int>(value == "true") : entry.second.as<int>()});
    } catch (const YAML::Exception&) {
      throw ParameterError(source + "." + control + " must be a whole number, true or false");
    }
  }
}

/// Removes the map `controls` from `tree` and returns it; empty where there is none.
YAML::Node takeControls(const YAML::Node& tree) {
  if (!tree.IsMap() || !tree[kControls].IsDefined()) return {};
  const YAML::Node controls = tree[kControls];
  YAML::Node same = tree;  // nodes refer to their content
  same.remove(kControls);
  return controls;
}

void checkDevice(const std::string& side, const std::string& device) {
  if (!device.empty()) return;
  throw ParameterError(
      side + ".device is not set: which is the " + side +
      " camera? `rosrun stereo_nav list_cameras` shows the cameras and what to write into the rig file");
}

void checkRollingShutter(const camera::CaptureParams& params) {
  const double period_ms = 1e3 / params.rate_hz;
  if (params.rolling_shutter_ms <= period_ms) return;
  std::ostringstream message;
  message << "rolling_shutter_ms is " << params.rolling_shutter_ms << ", more than the " << period_ms
          << " ms between two images at rate_hz: " << params.rate_hz
          << "; no camera reads one image while it takes the next. docs/capture.md tells how to measure it";
  throw ParameterError(message.str());
}

}  // namespace

void CameraSource::describe(ParameterVisitor& visitor) {
  visitor.text("device", device,
               "/dev/v4l/by-path/..., by-id/..., a bus_info or /dev/videoN; `list_cameras` shows them");
  visitor.text("calibration", calibration,
               "URL of the calibration, file:///... or package://...; empty: "
               "~/.ros/camera_info/{left,right}.yaml, where camera_calibration's COMMIT saves it");
}

void StereoCaptureParams::describe(ParameterVisitor& visitor) {
  visitSection(visitor, "left", left);
  visitSection(visitor, "right", right);
  visitor.text("frame_id", frame_id, "frame of both cameras' images: the left optical frame");
  visitor.flag("load_image_proc", load_image_proc,
               "rectify and compute disparity in this process; false: raw images only");
  capture.describe(visitor);
}

void CaptureSetup::read(const std::vector<ros_io::ParameterSource>& sources) {
  for (const auto& source : sources) {
    const YAML::Node tree = YAML::Clone(source.tree);
    const std::string of_both = source.name + ": " + kControls;
    const YAML::Node controls = takeControls(tree);
    addControls(controls, of_both, left_controls);
    addControls(controls, of_both, right_controls);
    if (tree.IsMap()) {
      for (auto* settings : {&left_controls, &right_controls}) {
        const std::string side = settings == &left_controls ? "left" : "right";
        if (tree[side].IsDefined()) {
          addControls(takeControls(tree[side]), source.name + ": " + side + "." + kControls, *settings);
        }
      }
    }
    stereo_nav::readParameters(tree, source.name, params);
  }
}

camera::StereoConfig CaptureSetup::toConfig() const {
  checkDevice("left", params.left.device);
  checkDevice("right", params.right.device);
  if (params.left.device == params.right.device) {
    throw ParameterError("left.device and right.device are both " + params.left.device +
                         ": a stereo camera needs two");
  }
  checkRollingShutter(params.capture);
  camera::StereoConfig config = params.capture.toConfig();
  config.left.device = params.left.device;
  config.left.controls = left_controls;
  config.right.device = params.right.device;
  config.right.controls = right_controls;
  return config;
}

}  // namespace stereo_nav::ros_io
