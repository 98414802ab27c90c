#pragma once

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "sim/simulation.h"

namespace stereo_nav::sim {

inline StereoCalibrationPair thesisRig() {
  return loadStereoCalibration(STEREO_NAV_SOURCE_DIR "/config/thesis");
}

/// A sensor that is open for a moment only.
inline SensorParams sensorWith(double read_noise, double shot_noise, double vignetting) {
  SensorParams sensor;
  sensor.exposure_ms = 0.0;
  sensor.read_noise = read_noise;
  sensor.shot_noise = shot_noise;
  sensor.vignetting = vignetting;
  return sensor;
}

/// A scenario without noise, blur, vignetting or sway, in a bare room.
inline Scenario cleanScenario() {
  Scenario scenario;
  scenario.sensor = sensorWith(0.0, 0.0, 0.0);
  scenario.motion.sway_deg = 0.0;
  scenario.imu.kind = ImuKind::kPerfect;
  PathStep wait;
  wait.action = PathStep::Action::kWait;
  wait.duration_s = 0.1;
  scenario.path = {wait};
  return scenario;
}

/// A wall across the view whose near face is `distance_m` ahead of the camera of a robot at the start.
inline ObjectParams wallAhead(double distance_m, TextureKind texture) {
  ObjectParams wall;
  wall.length_m = 0.2;
  wall.width_m = 8.0;
  wall.height_m = 4.0;
  wall.x_m = RigParams().camera.x_m + distance_m + 0.5 * wall.length_m;
  wall.material.texture = texture;
  return wall;
}

/// A plain white wall that begins at the camera's axis before a dark room; the robot turns at 60 deg/s.
inline Scenario edgeScenario() {
  Scenario scenario = cleanScenario();
  ObjectParams wall = wallAhead(3.0, TextureKind::kPlain);
  wall.y_m = 4.0 + RigParams().camera.y_m;
  wall.material.contrast = 0.0;
  wall.material.brightness = 0.8;
  scenario.scene.objects = {wall};
  for (Material* material :
       {&scenario.scene.room.walls, &scenario.scene.room.floor, &scenario.scene.room.ceiling}) {
    material->contrast = 0.0;
    material->brightness = 0.1;
  }
  PathStep turn;
  turn.action = PathStep::Action::kTurn;
  turn.angle_deg = 20.0;
  scenario.path = {turn};
  scenario.motion.max_yaw_rate_dps = 60.0;
  return scenario;
}

/// A raw image rectified by OpenCV with the calibration's R and P.
inline cv::Mat rectify(const CameraCalibration& calibration, const cv::Mat& raw) {
  cv::Mat K(3, 3, CV_64F), D(1, 5, CV_64F), R(3, 3, CV_64F), P(3, 3, CV_64F);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      K.at<double>(i, j) = calibration.K(i, j);
      R.at<double>(i, j) = calibration.R(i, j);
      P.at<double>(i, j) = calibration.P(i, j);
    }
  }
  for (int i = 0; i < 5; ++i) D.at<double>(i) = calibration.D[static_cast<std::size_t>(i)];
  cv::Mat map_x, map_y, rectified;
  cv::initUndistortRectifyMap(K, D, R, P, raw.size(), CV_32FC1, map_x, map_y);
  cv::remap(raw, rectified, map_x, map_y, cv::INTER_LINEAR);
  return rectified;
}

}  // namespace stereo_nav::sim
