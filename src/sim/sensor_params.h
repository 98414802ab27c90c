#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/auto_exposure.h"
#include "sim/image_processing.h"
#include "sim/lamp_flicker.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::sim {

/// What the parameters of a sensor are before a scenario changes single ones.
enum class SensorPreset {
  kKind,   ///< a machine vision camera: global shutter, linear, nothing automatic, nothing compressed
  kWebcam  ///< a webcam of the cheap kind in a room with lamps
};

/// Names as in scenario files.
const std::vector<std::pair<std::string, SensorPreset>>& sensorPresetNames();

/// The properties that both image sensors share.
struct SensorParams {
  double exposure_ms = 12.0;  ///< the longest one where exposure is automatic
  double rolling_shutter_ms = 0.0;
  double read_noise = 1.2;
  double shot_noise = 0.12;
  double vignetting = 0.15;
  SensorPreset preset = SensorPreset::kKind;
  double full_scale_ms = 0.0;  ///< 0: brightness does not depend on the exposure
  double lens_blur_px = 0.0;
  bool smooth_motion_blur = false;
  AutoExposureParams auto_exposure;
  FlickerParams flicker;
  ProcessingParams processing;

  void describe(ParameterVisitor& visitor);
};

/// Something that sticks to a lens: out of focus, it darkens a round part of every image.
struct SpeckParams {
  double opacity = 0.0;  ///< share of the light that it takes in its middle
  double x = 0.5;        ///< share of the image's width
  double y = 0.5;        ///< share of the image's height
  double radius = 0.02;  ///< share of the image's width

  void describe(ParameterVisitor& visitor);
};

/// The properties in which two cameras of one type differ.
struct CameraResponse {
  double gain = 1.0;
  double offset = 0.0;
  SpeckParams speck;

  void describe(ParameterVisitor& visitor);
};

/// Gives all parameters of the sensor and of both cameras the values of a preset.
void applyPreset(SensorPreset preset, SensorParams& sensor, CameraResponse& left, CameraResponse& right);

}  // namespace stereo_nav::sim
