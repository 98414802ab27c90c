#include "sim/sensor_params.h"

namespace stereo_nav::sim {
namespace {

/// A webcam of the cheap kind, 640x480: a pixel of 3 micrometres holds about 6000 electrons (shot noise
/// sqrt(255 / 6000) at grey level 1 of 255) and is read with about 10; the lens loses almost half the light
/// in the corners. Lamps on mains of 50 Hz, whose light sinks by a third 100 times a second.
SensorParams webcamSensor() {
  SensorParams sensor;
  sensor.preset = SensorPreset::kWebcam;
  sensor.exposure_ms = 25.0;
  sensor.rolling_shutter_ms = 28.0;
  sensor.read_noise = 0.45;
  sensor.shot_noise = 0.21;
  sensor.vignetting = 0.42;
  sensor.full_scale_ms = 70.0;
  sensor.lens_blur_px = 0.65;
  sensor.smooth_motion_blur = true;
  sensor.auto_exposure.on = true;
  sensor.flicker.mains_hz = 50.0;
  sensor.flicker.depth = 0.2;
  sensor.processing.gamma = 1.6;
  sensor.processing.sharpening = 0.9;
  sensor.processing.jpeg_kb = 40.0;
  return sensor;
}

}  // namespace

const std::vector<std::pair<std::string, SensorPreset>>& sensorPresetNames() {
  static const std::vector<std::pair<std::string, SensorPreset>> names = {{"kind", SensorPreset::kKind},
                                                                          {"webcam", SensorPreset::kWebcam}};
  return names;
}

void applyPreset(SensorPreset preset, SensorParams& sensor, CameraResponse& left, CameraResponse& right) {
  sensor = SensorParams();
  left = right = CameraResponse();
  if (preset == SensorPreset::kKind) return;
  sensor = webcamSensor();
  left.speck = {0.6, 0.68, 0.36, 0.022};
  right.gain = 0.94;  // no two of them are alike
}

void SensorParams::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "preset", preset, sensorPresetNames(),
            "values of all parameters of sensor, left and right that are not set themselves");
  visitor.real("exposure_ms", exposure_ms, {0.0, 100.0}, "ms",
               "time over which an image is collected; where it is automatic, the longest one");
  visitor.real("rolling_shutter_ms", rolling_shutter_ms, {0.0, 100.0}, "ms",
               "from the first row's exposure to the last one's; 0 is a global shutter");
  visitor.real("read_noise", read_noise, {0.0, 50.0}, "grey levels", "standard deviation in the dark");
  visitor.real("shot_noise", shot_noise, {0.0, 5.0}, "grey levels",
               "standard deviation at grey level 1; grows with the root");
  visitor.real("vignetting", vignetting, {0.0, 1.0}, "", "light lost in the corners");
  visitor.real("full_scale_ms", full_scale_ms, {0.0, 10000.0}, "ms",
               "exposure that shows white in full light at full scale, more in darker rooms; 0: images are "
               "equally bright with any exposure");
  visitor.real("lens_blur_px", lens_blur_px, {0.0, 10.0}, "px",
               "standard deviation of the spot that the lens makes of a point");
  visitor.flag("smooth_motion_blur", smooth_motion_blur,
               "the motion between the rays of a pixel is filled in, as far as the camera turns");
  visitSection(visitor, "auto_exposure", auto_exposure);
  visitSection(visitor, "flicker", flicker);
  visitSection(visitor, "processing", processing);
}

void SpeckParams::describe(ParameterVisitor& visitor) {
  visitor.real("opacity", opacity, {0.0, 1.0}, "",
               "light that a speck on the lens takes in its middle; 0: a clean lens");
  visitor.real("x", x, {0.0, 1.0}, "", "where the speck is, as a share of the image's width");
  visitor.real("y", y, {0.0, 1.0}, "", "where the speck is, as a share of the image's height");
  visitor.real("radius", radius, {0.001, 1.0}, "", "of the speck, as a share of the image's width");
}

void CameraResponse::describe(ParameterVisitor& visitor) {
  visitor.real("gain", gain, {0.0, 10.0}, "",
               "factor on the light; 1 shows a material's brightness as it is");
  visitor.real("offset", offset, {-100.0, 100.0}, "grey levels", "black level");
  visitSection(visitor, "speck", speck);
}

}  // namespace stereo_nav::sim
