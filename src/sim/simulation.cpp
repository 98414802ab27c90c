#include "sim/simulation.h"

#include <algorithm>
#include <cmath>

#include "sim/random.h"

namespace stereo_nav::sim {
namespace {

/// Time that the lamps take from one level to another.
constexpr double kFade_s = 0.2;

/// The share of an event at a time: 0 outside, 1 inside, with ramps before and after.
double share(const Event& event, double time_s) {
  return std::clamp(std::min(time_s - event.from_s, event.to_s - time_s) / kFade_s + 1.0, 0.0, 1.0);
}

}  // namespace

StereoCalibrationPair loadStereoCalibration(const std::string& folder) {
  return {loadCameraCalibration(folder + "/left.yaml"), loadCameraCalibration(folder + "/right.yaml")};
}

Simulation::Simulation(const Scenario& scenario, const StereoCalibrationPair& calibration, std::uint64_t seed)
    : scenario_(scenario),
      seed_(seed),
      scene_(scenario.scene),
      trajectory_(scenario.path, scenario.motion),
      pairs_(pairInstants(scenario.timing, trajectory_.duration_s(), seed)),
      imu_(simulateImu(scenario.imu, trajectory_, trajectory_.duration_s(), seed)),
      true_drive_(trueDrive(scenario.wheels, scenario.drive, seed)),
      left_(makeCamera(Side::kLeft, scaled(calibration.left, scenario.rig.image_scale))),
      right_(makeCamera(Side::kRight, scaled(calibration.right, scenario.rig.image_scale))) {
  if (!true_drive_.wheels.empty()) wheels_ = simulateWheels(scenario.wheels, true_drive_, trajectory_, seed);
}

std::unique_ptr<Simulation::Camera> Simulation::makeCamera(Side side,
                                                           const CameraCalibration& calibration) const {
  Eigen::Isometry3d T_rectified_raw = Eigen::Isometry3d::Identity();
  T_rectified_raw.linear() = calibration.R;
  T_rectified_raw.translation().x() = calibration.offsetX_m();
  const CameraResponse& response = side == Side::kLeft ? scenario_.left : scenario_.right;
  return std::make_unique<Camera>(
      Camera{calibration, scenario_.rig.T_base_camera() * T_rectified_raw,
             Renderer(scene_, calibration, scenario_.rig.samples_per_pixel),
             ImageSensor(calibration.width, calibration.height, scenario_.sensor, response)});
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

cv::Mat Simulation::image(Side side, std::size_t pair) const {
  const Camera& cam = camera(side);
  const double time_s = imageTime(side, pair);
  cv::Mat light;
  if (blocked(side, time_s)) {  // as with a hand on the lens, a little light comes through
    light = cv::Mat(cam.calibration.height, cam.calibration.width, CV_32FC1, cv::Scalar(8.0));
  } else {
    const Shutter shutter{time_s, 1e-3 * scenario_.sensor.exposure_ms,
                          1e-3 * scenario_.sensor.rolling_shutter_ms};
    light = cam.renderer.render([&](double t) { return cameraPose(side, t); }, shutter);
  }
  light *= lightLevel(time_s);
  return cam.sensor.expose(light, streamKey(seed_, Stream::kPixelNoise, side, pair));
}

}  // namespace stereo_nav::sim
