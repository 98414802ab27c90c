#include "sim/stereo_cameras.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/angles.h"
#include "sim/motion_smear.h"
#include "sim/random.h"

namespace stereo_nav::sim {
namespace {

/// Time that the lamps take from one level to another.
constexpr double kFade_s = 0.2;
/// Columns of the image from which the automatic exposure takes its mean.
constexpr double kMeterColumns = 40.0;
/// Motion between two rays of a pixel that needs no filling in.
constexpr double kSmallStep_px = 0.5;

/// The share of an event at a time: 0 outside, 1 inside, with ramps before and after.
double share(const Event& event, double time_s) {
  return std::clamp(std::min(time_s - event.from_s, event.to_s - time_s) / kFade_s + 1.0, 0.0, 1.0);
}

}  // namespace

StereoCameras::StereoCameras(const Scenario& scenario, const StereoCalibrationPair& calibration,
                             std::uint64_t seed)
    : scenario_(scenario),
      seed_(seed),
      nominal_{scaled(calibration.left, scenario.rig.image_scale),
               scaled(calibration.right, scenario.rig.image_scale)} {
  const TrueCameras cameras = trueCameras(scenario.calibration_error, nominal_, seed);
  left_ = makeCamera(Side::kLeft, cameras);
  right_ = makeCamera(Side::kRight, cameras);
}

std::unique_ptr<StereoCameras::Camera> StereoCameras::makeCamera(Side side,
                                                                 const TrueCameras& cameras) const {
  const CameraCalibration& calibration = of(cameras.calibration, side);
  Eigen::Isometry3d T_rectified_raw = Eigen::Isometry3d::Identity();
  T_rectified_raw.linear() = calibration.R;
  T_rectified_raw.translation().x() = calibration.offsetX_m();
  const CameraResponse& response = side == Side::kLeft ? scenario_.left : scenario_.right;
  return std::make_unique<Camera>(
      Camera{calibration, scenario_.rig.T_base_camera() * cameras.T_nominal_true * T_rectified_raw,
             response.gain, Renderer(calibration, scenario_.rig.samples_per_pixel),
             Renderer(scaled(calibration, kMeterColumns / calibration.width), 1),
             ImageSensor(calibration.width, calibration.height, scenario_.sensor, response)});
}

double StereoCameras::lightLevel(double time_s) const {
  double level = 1.0;
  for (const Event& event : scenario_.events) {
    if (event.kind == Event::Kind::kLight) level += share(event, time_s) * (event.level - level);
  }
  return level;
}

bool StereoCameras::blocked(Side side, double time_s) const {
  const Event::Kind one = side == Side::kLeft ? Event::Kind::kBlockLeft : Event::Kind::kBlockRight;
  return std::any_of(scenario_.events.begin(), scenario_.events.end(), [&](const Event& event) {
    return (event.kind == one || event.kind == Event::Kind::kBlockBoth) && time_s >= event.from_s &&
           time_s < event.to_s;
  });
}

double StereoCameras::metered(Side side, const Scene& scene, const BasePath& base, double middle_s,
                              const ExposureSetting& setting) const {
  const Camera& cam = camera(side);
  const cv::Mat seen = signal(side, scene, cam.meter, base, middle_s, setting);
  return meteredGrey(seen, cam.gain * setting.gain, cam.sensor.processing());
}

Shutter StereoCameras::shutter(double middle_s, const ExposureSetting& setting) const {
  return {middle_s, 1e-3 * setting.exposure_ms, 1e-3 * scenario_.sensor.rolling_shutter_ms};
}

cv::Mat StereoCameras::signal(Side side, const Scene& scene, const Renderer& renderer, const BasePath& base,
                              double middle_s, const ExposureSetting& setting) const {
  const Shutter open = shutter(middle_s, setting);
  cv::Mat light;
  if (blocked(side, open.middle_s)) {  // as with a hand on the lens, a little light comes through
    light = cv::Mat(renderer.size(), CV_32FC1, cv::Scalar(8.0));
  } else {
    light = renderer.render(
        scene, [&](double t) { return base(t) * T_base_raw(side); }, open);
  }
  light *= lightLevel(open.middle_s) * signalPerLight(scenario_.sensor, setting.exposure_ms);
  if (scenario_.sensor.flicker.mains_hz > 0.0) flicker(open, light);
  return light;
}

void StereoCameras::flicker(const Shutter& open, cv::Mat& light) const {
  const double phase_rad = 2.0 * kPi * uniformDraw(streamKey(seed_, Stream::kLight), 0);
  for (int row = 0; row < light.rows; ++row) {
    const double middle_s = open.middle_s + open.readout_s * ((row + 0.5) / light.rows - 0.5);
    light.row(row) *= lampLight(scenario_.sensor.flicker, phase_rad, middle_s, open.exposure_s);
  }
}

void StereoCameras::blur(Side side, const BasePath& base, const Shutter& open, cv::Mat& light) const {
  if (scenario_.sensor.smooth_motion_blur) {
    const auto rotation = [&](double t) { return (base(t) * T_base_raw(side)).linear().eval(); };
    const double half_s = 0.5 * open.exposure_s / scenario_.rig.samples_per_pixel;
    const Eigen::Vector2d step_px = turnedBy(camera(side).calibration, rotation(open.middle_s - half_s),
                                             rotation(open.middle_s + half_s));
    if (step_px.norm() > kSmallStep_px) light = smeared(light, step_px);
  }
  const double sigma_px = scenario_.sensor.lens_blur_px;
  if (sigma_px > 0.0) cv::GaussianBlur(light, light, cv::Size(), sigma_px, sigma_px, cv::BORDER_REPLICATE);
}

cv::Mat StereoCameras::image(Side side, const Scene& scene, const BasePath& base, double middle_s,
                             const ExposureSetting& setting, std::size_t index) const {
  const Camera& cam = camera(side);
  cv::Mat light = signal(side, scene, cam.renderer, base, middle_s, setting);
  blur(side, base, shutter(middle_s, setting), light);
  return cam.sensor.expose(light, streamKey(seed_, Stream::kPixelNoise, side, index), setting.gain);
}

}  // namespace stereo_nav::sim
