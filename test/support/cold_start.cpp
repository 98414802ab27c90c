#include "support/cold_start.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "core/angles.h"
#include "core/base_pose.h"
#include "core/optical_axes.h"
#include "core/statistics.h"
#include "odometry/method/watched_odometry.h"
#include "sim/image_sensor.h"
#include "sim/random.h"
#include "stereo_nav/estimation/base_odometry.h"

namespace stereo_nav::test {
namespace {

constexpr int kWidth = 320, kHeight = 240;
constexpr double kFocal_px = 277.0;  // 60 degrees of view
constexpr double kImuPeriod_s = 0.01;

Eigen::Isometry3d baseToCamera() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = opticalToBody();
  T.translation() << 0.1, 0.06, 0.3;
  return T;
}

/// Error of the pose in the axes of odom, as the published covariance counts it.
double mahalanobis(const estimation::BaseEstimate& estimate, const Eigen::Isometry3d& truth) {
  const Vector6d in_base = logMotion(truth.inverse() * estimate.T_odom_base);
  Vector6d error;
  error << estimate.T_odom_base.linear() * in_base.head<3>(),
      estimate.T_odom_base.linear() * in_base.tail<3>();
  return std::sqrt(error.dot(estimate.pose_covariance.ldlt().solve(error)));
}

}  // namespace

ColdStartCounts& ColdStartCounts::operator+=(const ColdStartCounts& other) {
  frames += other.frames;
  tracking += other.tracking;
  outside += other.outside;
  beyond += other.beyond;
  wrong += other.wrong;
  begun += other.begun;
  worst = std::max(worst, other.worst);
  return *this;
}

ColdStart::ColdStart(int number)
    : number_(number),
      kind_(static_cast<Kind>(number % kKinds)),
      has_imu_(number / kKinds % 2 == 0),
      is_bare_(number / kKinds % 4 >= 2 && kind_ != Kind::kCovered) {
  sim::RandomStream random(sim::streamKey(static_cast<std::uint64_t>(number), 71));
  const double sign = random.uniform(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
  switch (kind_) {
    case Kind::kTurning:
      speed_m_s_ = random.uniform(0.0, 1.0);
      turn_rad_s_ = sign * random.uniform(15.0, 60.0) / kDegPerRad;
      break;
    case Kind::kFast:
      speed_m_s_ = random.uniform(1.0, 15.0);
      acceleration_m_s2_ = random.uniform(-2.0, 2.0);
      turn_rad_s_ = sign * random.uniform(0.0, std::min(0.7, 4.0 / speed_m_s_));
      break;
    case Kind::kBlurred:
      speed_m_s_ = random.uniform(0.3, 2.0);
      turn_rad_s_ = sign * random.uniform(5.0, 40.0) / kDegPerRad;
      exposure_s_ = random.uniform(0.03, 0.09);
      break;
    case Kind::kCovered:
      speed_m_s_ = random.uniform(0.2, 4.0);
      turn_rad_s_ = sign * random.uniform(0.0, 30.0) / kDegPerRad;
      break;
  }
  baseline_m_ = 0.1 + 0.03 * speed_m_s_;
  for (int axis = 0; axis < 3; ++axis) gyro_bias_rad_s_[axis] = random.uniform(-0.01, 0.01);
}

std::string ColdStart::text() const {
  static const char* const kNames[] = {"turning", "fast", "blurred", "half covered"};
  char line[120];
  std::snprintf(line, sizeof(line), "%3d %-12s %4.1f m/s %6.1f deg/s, exposure %2.0f ms, %s, %s", number_,
                kNames[static_cast<int>(kind_)], speed_m_s_, turn_rad_s_ * kDegPerRad, 1e3 * exposure_s_,
                has_imu_ ? "IMU" : "no IMU", is_bare_ ? "plain walls" : "textured walls");
  return line;
}

Eigen::Isometry3d ColdStart::basePose(double time_s) const {
  Vector6d way = Vector6d::Zero();
  way(0) = speed_m_s_ * time_s + 0.5 * acceleration_m_s2_ * time_s * time_s;
  way(5) = turn_rad_s_ * time_s;
  return expMotion(way);
}

sim::SceneParams ColdStart::scene() const {
  // Everything is larger the faster the rig is: a room, a yard, a street.
  const double scale = 1.0 + 0.25 * speed_m_s_;
  const double way_m = std::max(basePose(kFrames * kPeriod_s).translation().norm(), 1.0);
  sim::SceneParams scene;
  scene.world_seed = 1 + number_;
  sim::RoomParams& room = scene.room;
  room.x_min_m = -3.0 * scale - way_m;
  room.x_max_m = 6.0 * scale + way_m;
  room.y_max_m = 3.0 * scale + (turn_rad_s_ > 0.0 ? way_m : 0.0);
  room.y_min_m = -3.0 * scale - (turn_rad_s_ < 0.0 ? way_m : 0.0);
  room.height_m = 3.0 * scale;
  room.floor = {sim::TextureKind::kWood, 0.42, 0.7, 2.5 * scale};
  room.walls = {is_bare_ ? sim::TextureKind::kPlain : sim::TextureKind::kTiles, 0.55, 0.8, 3.0 * scale};
  room.ceiling = {sim::TextureKind::kTiles, 0.65, 0.4, 6.0 * scale};
  for (const double side : {-1.0, 1.0}) {
    sim::ClutterParams clutter;
    clutter.count = is_bare_ ? 3 : 12;
    clutter.x_min_m = 1.5 * scale;
    clutter.x_max_m = room.x_max_m - 1.0;
    clutter.y_min_m = side < 0.0 ? room.y_min_m : 1.2 * scale;
    clutter.y_max_m = side < 0.0 ? -1.2 * scale : room.y_max_m;
    clutter.size_min_m = 0.2 * scale;
    clutter.size_max_m = 0.6 * scale;
    clutter.height_min_m = 0.4 * scale;
    clutter.height_max_m = 1.6 * scale;
    clutter.material = {sim::TextureKind::kClutter, 0.5, 0.8, 2.5 * scale};
    scene.clutter.push_back(clutter);
  }
  return scene;
}

sim::CameraCalibration ColdStart::camera() const {
  sim::CameraCalibration camera;
  camera.width = kWidth;
  camera.height = kHeight;
  camera.K << kFocal_px, 0.0, 0.5 * (kWidth - 1), 0.0, kFocal_px, 0.5 * (kHeight - 1), 0.0, 0.0, 1.0;
  camera.P.leftCols<3>() = camera.K;
  return camera;
}

vision::StereoCalibration ColdStart::calibration() const {
  vision::StereoCalibration calibration;
  calibration.fx = calibration.fy = kFocal_px;
  calibration.cx = calibration.right_cx = 0.5 * (kWidth - 1);
  calibration.cy = 0.5 * (kHeight - 1);
  calibration.baseline_m = baseline_m_;
  calibration.width = kWidth;
  calibration.height = kHeight;
  return calibration;
}

cv::Mat ColdStart::image(const sim::Scene& scene, const sim::Renderer& renderer, bool is_right,
                         int frame) const {
  Eigen::Isometry3d T_base_optical = baseToCamera();
  if (is_right) T_base_optical.translate(Eigen::Vector3d(baseline_m_, 0.0, 0.0));
  const auto path = [&](double time_s) { return Eigen::Isometry3d(basePose(time_s) * T_base_optical); };
  cv::Mat light = renderer.render(scene, path, {kPeriod_s * frame, exposure_s_, 0.0});
  if (kind_ == Kind::kCovered) cover(is_right, frame, light);
  sim::SensorParams sensor;
  sensor.read_noise = 2.0;
  const auto key = sim::streamKey(static_cast<std::uint64_t>(number_), frame, is_right ? 1 : 0);
  return sim::ImageSensor(kWidth, kHeight, sensor, sim::CameraResponse()).expose(light, key);
}

void ColdStart::cover(bool is_right, int frame, cv::Mat& light) const {
  // A hand before the lenses, half of the view wide, that wavers: dark, and so near that its edge is a blur.
  constexpr double kDisparity_px = 60.0, kBlur_px = 12.0;
  const bool covers_left = number_ / kKinds % 4 < 2;
  const double wander_px = 20.0 * std::sin(4.0 * kPeriod_s * frame + 0.7 * number_);
  const double edge_px = 0.5 * kWidth + wander_px - (is_right ? kDisparity_px : 0.0);
  for (int x = 0; x < kWidth; ++x) {
    const double behind_px = covers_left ? edge_px - x : x - edge_px;
    const double opacity = std::clamp(0.5 + behind_px / (2.0 * kBlur_px), 0.0, 1.0);
    light.col(x) = light.col(x) * (1.0 - opacity) + 30.0 * opacity;
  }
}

std::vector<ImuSample> ColdStart::imu(double from_s, double to_s) const {
  std::vector<ImuSample> samples;
  const auto first = static_cast<std::int64_t>(std::ceil(from_s / kImuPeriod_s - 1e-9));
  const auto last = static_cast<std::int64_t>(std::floor(to_s / kImuPeriod_s + 1e-9));
  for (std::int64_t i = first; i <= last; ++i) {
    ImuSample sample;
    sample.time_s = kImuPeriod_s * static_cast<double>(i);
    const Eigen::Matrix3d turn = (basePose(sample.time_s - 0.5 * kImuPeriod_s).inverse() *
                                  basePose(sample.time_s + 0.5 * kImuPeriod_s))
                                     .linear();
    sample.angular_velocity = logRotation(turn) / kImuPeriod_s + gyro_bias_rad_s_;
    const auto key = sim::streamKey(static_cast<std::uint64_t>(number_), 3, i);
    for (int axis = 0; axis < 3; ++axis)
      (*sample.angular_velocity)[axis] += 0.002 * sim::normalDraw(key, static_cast<std::uint64_t>(axis));
    samples.push_back(sample);
  }
  return samples;
}

ColdStartCounts ColdStart::run() const {
  const sim::Scene scene(this->scene());
  const sim::Renderer renderer(camera(), 4);
  const Eigen::Isometry3d T_base_camera = baseToCamera();
  odometry::WatchedOdometry odometry({}, calibration(),
                                     {T_base_camera.linear(), Eigen::Matrix3d::Identity()});
  estimation::BaseOdometry base({}, T_base_camera);
  const double inside = std::sqrt(chiSquareQuantile(6, 0.9973));
  ColdStartCounts counts;
  // Where the map in use began: as published, and in truth.
  Eigen::Isometry3d T_odom_map = Eigen::Isometry3d::Identity(), truth_of_map = Eigen::Isometry3d::Identity();
  double path_m = 0.0;
  for (int i = 0; i < kFrames; ++i) {
    odometry::StereoFrame frame;
    frame.left_time_s = frame.right_time_s = kPeriod_s * i;
    frame.left = image(scene, renderer, false, i);
    frame.right = image(scene, renderer, true, i);
    if (has_imu_) {
      for (const ImuSample& sample :
           imu(kPeriod_s * (i - 1) + 0.5 * kImuPeriod_s, kPeriod_s * i + kImuPeriod_s))
        odometry.addImu(sample);
    }
    const odometry::FrameResult result = odometry.process(frame);
    const estimation::BaseEstimate estimate = base.update(result, frame.left_time_s);
    const Eigen::Isometry3d truth = basePose(frame.left_time_s);
    ++counts.frames;
    path_m +=
        (basePose(frame.left_time_s).translation() - basePose(kPeriod_s * std::max(0, i - 1)).translation())
            .norm();
    if (result.keyframe && result.state != odometry::State::kTracking) {
      T_odom_map = estimate.T_odom_base;
      truth_of_map = truth;
      path_m = 0.0;
    }
    if (result.state != odometry::State::kTracking) continue;
    counts.begun = 1;
    ++counts.tracking;
    const double distance = mahalanobis(estimate, truth);
    const Eigen::Isometry3d moved = T_odom_map.inverse() * estimate.T_odom_base;
    const double error_m = (moved.translation() - (truth_of_map.inverse() * truth).translation()).norm();
    counts.worst = std::max(counts.worst, distance);
    counts.outside += distance > inside ? 1 : 0;
    counts.beyond += distance > 6.0 ? 1 : 0;
    counts.wrong += error_m > std::max(0.05, 0.02 * path_m) ? 1 : 0;
  }
  return counts;
}

}  // namespace stereo_nav::test
