#include "sim/simulation.h"

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

Simulation::Simulation(const Scenario& scenario, const StereoCalibrationPair& calibration, std::uint64_t seed)
    : scenario_(scenario),
      seed_(seed),
      scene_(scenario.scene),
      trajectory_(scenario.path, scenario.motion),
      pairs_(pairInstants(scenario.timing, trajectory_.duration_s(), seed)),
      imu_(simulateImu(scenario.imu, trajectory_, trajectory_.duration_s(), seed)),
      true_drive_(trueDrive(scenario.wheels, scenario.drive, seed)),
      nominal_{scaled(calibration.left, scenario.rig.image_scale),
               scaled(calibration.right, scenario.rig.image_scale)} {
  const TrueCameras cameras = trueCameras(scenario.calibration_error, nominal_, seed);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    std::unique_ptr<Camera>& made = side == Side::kLeft ? left_ : right_;
    made = makeCamera(side, cameras);
    made->exposures = planned(side);
  }
  if (!true_drive_.wheels.empty()) wheels_ = simulateWheels(scenario.wheels, true_drive_, trajectory_, seed);
}

std::unique_ptr<Simulation::Camera> Simulation::makeCamera(Side side, const TrueCameras& cameras) const {
  const CameraCalibration& calibration = of(cameras.calibration, side);
  Eigen::Isometry3d T_rectified_raw = Eigen::Isometry3d::Identity();
  T_rectified_raw.linear() = calibration.R;
  T_rectified_raw.translation().x() = calibration.offsetX_m();
  const CameraResponse& response = side == Side::kLeft ? scenario_.left : scenario_.right;
  return std::make_unique<Camera>(
      Camera{calibration,
             scenario_.rig.T_base_camera() * cameras.T_nominal_true * T_rectified_raw,
             Renderer(scene_, calibration, scenario_.rig.samples_per_pixel),
             ImageSensor(calibration.width, calibration.height, scenario_.sensor, response),
             {}});
}

double Simulation::imageTime(Side side, std::size_t pair) const {
  return side == Side::kLeft ? pairs_[pair].left_s : pairs_[pair].right_s;
}

Eigen::Isometry3d Simulation::cameraPose(Side side, double time_s) const {
  return trajectory_.pose(time_s) * camera(side).T_base_raw;
}

double Simulation::lightLevel(double time_s) const {
  double level = 1.0;
  for (const Event& event : scenario_.events) {
    if (event.kind == Event::Kind::kLight) level += share(event, time_s) * (event.level - level);
  }
  return level;
}

bool Simulation::blocked(Side side, double time_s) const {
  const Event::Kind one = side == Side::kLeft ? Event::Kind::kBlockLeft : Event::Kind::kBlockRight;
  return std::any_of(scenario_.events.begin(), scenario_.events.end(), [&](const Event& event) {
    return (event.kind == one || event.kind == Event::Kind::kBlockBoth) && time_s >= event.from_s &&
           time_s < event.to_s;
  });
}

std::vector<ExposureSetting> Simulation::planned(Side side) const {
  if (!scenario_.sensor.auto_exposure.on) return planExposures(scenario_.sensor, pairs_.size(), nullptr);
  const Camera& cam = camera(side);
  const double gain = (side == Side::kLeft ? scenario_.left : scenario_.right).gain;
  const Renderer few(scene_, scaled(cam.calibration, kMeterColumns / cam.calibration.width), 1);
  return planExposures(
      scenario_.sensor, pairs_.size(), [&](std::size_t pair, const ExposureSetting& setting) {
        return meteredGrey(signal(side, pair, few, setting), gain * setting.gain, cam.sensor.processing());
      });
}

Shutter Simulation::shutter(Side side, std::size_t pair, const ExposureSetting& setting) const {
  return {imageTime(side, pair), 1e-3 * setting.exposure_ms, 1e-3 * scenario_.sensor.rolling_shutter_ms};
}

cv::Mat Simulation::signal(Side side, std::size_t pair, const Renderer& renderer,
                           const ExposureSetting& setting) const {
  const Shutter open = shutter(side, pair, setting);
  cv::Mat light;
  if (blocked(side, open.middle_s)) {  // as with a hand on the lens, a little light comes through
    light = cv::Mat(renderer.size(), CV_32FC1, cv::Scalar(8.0));
  } else {
    light = renderer.render([&](double t) { return cameraPose(side, t); }, open);
  }
  light *= lightLevel(open.middle_s) * signalPerLight(scenario_.sensor, setting.exposure_ms);
  if (scenario_.sensor.flicker.mains_hz > 0.0) flicker(open, light);
  return light;
}

void Simulation::flicker(const Shutter& open, cv::Mat& light) const {
  const double phase_rad = 2.0 * kPi * uniformDraw(streamKey(seed_, Stream::kLight), 0);
  for (int row = 0; row < light.rows; ++row) {
    const double middle_s = open.middle_s + open.readout_s * ((row + 0.5) / light.rows - 0.5);
    light.row(row) *= lampLight(scenario_.sensor.flicker, phase_rad, middle_s, open.exposure_s);
  }
}

void Simulation::blur(Side side, const Shutter& open, cv::Mat& light) const {
  if (scenario_.sensor.smooth_motion_blur) {
    const double half_s = 0.5 * open.exposure_s / scenario_.rig.samples_per_pixel;
    const Eigen::Vector2d step_px =
        turnedBy(camera(side).calibration, cameraPose(side, open.middle_s - half_s).linear(),
                 cameraPose(side, open.middle_s + half_s).linear());
    if (step_px.norm() > kSmallStep_px) light = smeared(light, step_px);
  }
  const double sigma_px = scenario_.sensor.lens_blur_px;
  if (sigma_px > 0.0) cv::GaussianBlur(light, light, cv::Size(), sigma_px, sigma_px, cv::BORDER_REPLICATE);
}

cv::Mat Simulation::image(Side side, std::size_t pair) const {
  const Camera& cam = camera(side);
  const ExposureSetting& setting = exposure(side, pair);
  cv::Mat light = signal(side, pair, cam.renderer, setting);
  blur(side, shutter(side, pair, setting), light);
  return cam.sensor.expose(light, streamKey(seed_, Stream::kPixelNoise, side, pair), setting.gain);
}

}  // namespace stereo_nav::sim
