#include "fusion_scene.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"

namespace stereo_nav::estimation::test {
namespace {

using Kind = Measurement::Kind;
constexpr double kStart_s = 1000.0;
constexpr double kStep_s = 0.01;
constexpr double kGyroSigma = 0.002;
constexpr double kWheelSigma = 0.03;
constexpr double kReadingSigma_m = 0.004;
constexpr double kReadingSigma_rad = 0.0015;

Eigen::Vector3d trueTwist(double t) {
  const double begin = std::min(1.0, std::max(0.0, (t - 1.5) / 1.0));
  return begin * Eigen::Vector3d(0.45 + 0.15 * std::sin(0.7 * t), 0.12 * std::sin(0.45 * t),
                                 0.6 * std::sin(0.31 * t));
}

/// An odometry that integrates the true motion with noise of a stated growth.
class NoisyOdometry {
 public:
  NoisyOdometry(int channel, double way_share, double turn_share)
      : channel_(channel), way_share_(way_share), turn_share_(turn_share) {}

  Measurement measure(double time_s, const Eigen::Isometry2d& T_true, std::mt19937& random) {
    std::normal_distribution<double> normal;
    const Eigen::Isometry2d motion = T_last_.inverse() * T_true;
    T_last_ = T_true;
    const double way_variance = std::pow(way_share_, 2) * motion.translation().norm() + 1e-8;
    const double turn_variance = std::pow(turn_share_, 2) * std::abs(logPlanar(motion)[2]) + 1e-9;
    const Eigen::Vector3d noise(std::sqrt(way_variance) * normal(random),
                                std::sqrt(way_variance) * normal(random),
                                std::sqrt(turn_variance) * normal(random));
    const Eigen::Matrix3d carry = adjointPlanar(motion.inverse());
    covariance_ = (carry * covariance_ * carry.transpose()).eval();
    covariance_.diagonal() += Eigen::Vector3d(way_variance, way_variance, turn_variance);
    T_odom_ = T_odom_ * motion * expPlanar(noise);
    const Eigen::Vector3d reading(kReadingSigma_m * normal(random), kReadingSigma_m * normal(random),
                                  kReadingSigma_rad * normal(random));
    Measurement measurement;
    measurement.channel = channel_;
    measurement.time_s = time_s;
    measurement.kind = Kind::kMotion;
    measurement.fields = {0, 1, 5};
    measurement.pose = inSpace(T_odom_ * expPlanar(reading));
    measurement.covariance = spatialCovariance(inAxesOf(T_odom_, covariance_));
    return measurement;
  }

 private:
  int channel_;
  double way_share_, turn_share_;
  Eigen::Isometry2d T_last_ = Eigen::Isometry2d::Identity();
  Eigen::Isometry2d T_odom_ = Eigen::Isometry2d::Identity();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

Measurement wheelsOf(double time_s, const Eigen::Vector3d& twist, const Eigen::Vector3d& scale,
                     std::mt19937& random) {
  std::normal_distribution<double> normal;
  Measurement measurement;
  measurement.channel = channel::kWheels;
  measurement.time_s = time_s;
  measurement.kind = Kind::kTwist;
  measurement.fields = {0, 1, 5};
  const int rows[3] = {0, 1, 5};
  for (int i = 0; i < 3; ++i)
    measurement.value[rows[i]] = twist[i] / (1.0 + scale[i]) + kWheelSigma * normal(random);
  measurement.covariance = Matrix6d::Identity() * kWheelSigma * kWheelSigma;
  return measurement;
}

Measurement gyroOf(double time_s, double rate, std::mt19937& random) {
  Measurement measurement;
  measurement.channel = channel::kGyro;
  measurement.time_s = time_s;
  measurement.kind = Kind::kRate;
  measurement.fields = {5};
  measurement.value[5] = rate + kGyroSigma * std::normal_distribution<double>()(random);
  measurement.covariance = Matrix6d::Identity() * kGyroSigma * kGyroSigma;
  return measurement;
}

Measurement gnssOf(double time_s, const Eigen::Isometry2d& T_true, std::mt19937& random) {
  std::normal_distribution<double> normal;
  Measurement measurement;
  measurement.channel = channel::kGnss;
  measurement.time_s = time_s;
  measurement.kind = Kind::kPose;
  measurement.fields = {0, 1};
  measurement.pose = inSpace(T_true);
  measurement.pose.translation() += Eigen::Vector3d(0.3 * normal(random), 0.3 * normal(random), 0.0);
  measurement.covariance = Matrix6d::Identity() * 0.09;
  return measurement;
}

/// `clock_s` is added to the robot's clock.
SceneSample sampleOf(double time_s, double clock_s, const Eigen::Isometry2d& T_true,
                     const FusionFilter& filter) {
  SceneSample sample;
  sample.time_s = time_s - kStart_s;
  sample.T_true = T_true;
  sample.estimate = filter.estimate(time_s + clock_s);
  const Eigen::Isometry2d T_estimated = planarPart(sample.estimate.T_world_base);
  sample.error << T_estimated.translation() - T_true.translation(),
      wrapRadians(Eigen::Rotation2Dd(T_estimated.linear()).angle() -
                  Eigen::Rotation2Dd(T_true.linear()).angle());
  const Eigen::Matrix3d P = planarCovariance(sample.estimate.pose_covariance);
  sample.nees = sample.error.dot((P + 1e-12 * Eigen::Matrix3d::Identity()).ldlt().solve(sample.error));
  return sample;
}

struct Arrival {
  double received_s;
  Measurement measurement;
};

}  // namespace

FusionFilter sceneFilter(const SceneOptions& options) {
  std::vector<Channel> channels(options.gnss ? 5 : options.stereo ? 4 : options.laser ? 3 : 2);
  const char* const names[5] = {"wheels", "gyroscope", "laser", "stereo", "gnss"};
  const Kind kinds[5] = {Kind::kTwist, Kind::kRate, Kind::kMotion, Kind::kMotion, Kind::kPose};
  for (std::size_t i = 0; i < channels.size(); ++i) {
    channels[i].name = names[i];
    channels[i].kind = kinds[i];
    channels[i].reading_sigma_m = kReadingSigma_m;
    channels[i].reading_sigma_rad = kReadingSigma_rad;
  }
  channels[channel::kWheels].wheels = true;
  StateParts parts;
  parts.planar = parts.wheel_scales = true;
  parts.gyro = options.gyro;
  parts.wheel_turns = !options.gyro;
  parts.anchors = channels.size() > 3 ? 2 : channels.size() > 2 ? 1 : 0;
  return FusionFilter(FilterParams(), parts, channels);
}

SceneResult runScene(const SceneOptions& options) {
  std::mt19937 random(options.seed);
  FusionFilter filter = sceneFilter(options);
  NoisyOdometry laser(channel::kLaser, 0.01, 0.004), stereo(channel::kStereo, 0.015, 0.006);
  Eigen::Isometry2d T_true = Eigen::Isometry2d::Identity();
  SceneResult result;
  std::vector<Arrival> waiting;
  double clock_s = 0.0;
  const auto send = [&](Measurement measurement) {
    double received_s = measurement.time_s + 1e-4;
    measurement.time_s += clock_s;
    received_s += clock_s;
    if (options.fault && !options.fault(measurement, received_s)) return;
    if (waiting.empty() && received_s < measurement.time_s + 0.5 * kStep_s) {
      filter.add(std::move(measurement), received_s);
    } else {
      waiting.push_back({received_s, std::move(measurement)});
    }
  };
  const int sampled = static_cast<int>(std::lround(options.sample_period_s / kStep_s));
  const int steps = static_cast<int>(std::lround(options.duration_s / kStep_s));
  for (int step = 0; step <= steps; ++step) {
    const double t = step * kStep_s, time_s = kStart_s + t;
    const Eigen::Vector3d twist = trueTwist(t);
    clock_s = t < options.clock_back_at_s ? 0.0 : -10.0;
    if (options.gyro) send(gyroOf(time_s, twist[2] + options.gyro_bias_rad_s, random));
    if (step % 2 == 0) {
      const double unseen_turn = options.wheel_turn_per_way_rad_m * twist[0] / (1.0 + options.wheel_scale[0]);
      send(wheelsOf(time_s, twist - Eigen::Vector3d(0.0, 0.0, unseen_turn), options.wheel_scale, random));
    }
    if (options.laser && step % 10 == 0) send(laser.measure(time_s, T_true, random));
    if (options.stereo && step % 10 == 5) send(stereo.measure(time_s, T_true, random));
    if (options.gnss && step % 20 == 7) send(gnssOf(time_s, T_true, random));
    for (auto it = waiting.begin(); it != waiting.end();) {
      if (it->received_s > time_s + 0.5 * kStep_s && it->received_s < time_s + 5.0) {
        ++it;
        continue;
      }
      filter.add(std::move(it->measurement), it->received_s);
      it = waiting.erase(it);
    }
    if (step % sampled == 0 && filter.started())
      result.samples.push_back(sampleOf(time_s, clock_s, T_true, filter));
    T_true = T_true * expPlanar(trueTwist(t + 0.5 * kStep_s) * kStep_s);
    for (const std::string& text : filter.takeAnnouncements()) result.announcements.push_back(text);
  }
  result.statistics = filter.statistics();
  return result;
}

}  // namespace stereo_nav::estimation::test
