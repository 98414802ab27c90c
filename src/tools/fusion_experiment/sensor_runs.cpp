#include "tools/fusion_experiment/sensor_runs.h"

#include <algorithm>
#include <future>
#include <memory>

#include "core/planar_motion.h"
#include "odometry/laser/laser_odometry.h"
#include "odometry/method/watched_odometry.h"
#include "odometry/wheel/wheel_odometry.h"
#include "ros/package_files.h"
#include "ros/simulated_messages.h"
#include "ros/stereo_processing.h"
#include "sim/wall_map.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "stereo_nav/estimation/base_odometry.h"
#include "tools/fusion_experiment/simulated_ranging.h"

namespace stereo_nav::tools {
namespace {

using Kind = estimation::Measurement::Kind;
constexpr double kGyroSigma_rad_s = 0.002;
constexpr double kVisionDelay_s = 0.02;

Sensed motionAt(double time_s, double received_s, const Eigen::Isometry3d& pose, const Matrix6d& covariance) {
  Sensed sensed;
  sensed.received_s = kStart_s + received_s;
  sensed.measurement.time_s = kStart_s + time_s;
  sensed.measurement.kind = Kind::kMotion;
  sensed.measurement.pose = pose;
  sensed.measurement.covariance = covariance;
  return sensed;
}

/// Wheels as speeds, and as the poses that help the laser.
struct WheelRun {
  std::vector<Sensed> speeds;
  std::vector<std::pair<double, Eigen::Isometry2d>> poses;
};

WheelRun runWheels(const sim::Simulation& simulation) {
  odometry::WheelOdometryParams params;
  params.drive = simulation.scenario().drive;
  odometry::WheelOdometry odometry(params);
  WheelRun run;
  for (const sim::SimulatedTicks& ticks : simulation.wheels()) {
    const odometry::WheelOdometryResult result =
        odometry.process({ticks.time_s, ticks.pulses, ticks.steering_rad, std::nullopt});
    Sensed sensed{kStart_s + ticks.time_s, {}};
    sensed.measurement.time_s = kStart_s + ticks.time_s;
    sensed.measurement.kind = Kind::kTwist;
    sensed.measurement.value << result.twist.x(), result.twist.y(), 0.0, 0.0, 0.0, result.twist.z();
    sensed.measurement.covariance = spatialCovariance(result.twist_covariance);
    run.speeds.push_back(sensed);
    run.poses.emplace_back(ticks.time_s, result.T_odom_base);
  }
  return run;
}

std::vector<Sensed> runGyro(const sim::Simulation& simulation) {
  std::vector<Sensed> rates;
  for (const ImuSample& sample : simulation.imu()) {
    if (!sample.angular_velocity)
      throw InputError("the IMU of the scenario gives no rates: set imu.kind=raw");
    Sensed sensed{kStart_s + sample.time_s, {}};
    sensed.measurement.time_s = kStart_s + sample.time_s;
    sensed.measurement.kind = Kind::kRate;
    sensed.measurement.value.tail<3>() = *sample.angular_velocity;
    sensed.measurement.covariance = Matrix6d::Identity() * kGyroSigma_rad_s * kGyroSigma_rad_s;
    rates.push_back(sensed);
  }
  return rates;
}

std::vector<Sensed> runLaser(const sim::Simulation& simulation, const std::vector<odometry::LaserScan>& scans,
                             const WheelRun* wheels, bool gyro) {
  odometry::LaserParams params;
  const std::string file = ros_io::configFile("laser_odometry.yaml");
  readParameters(loadYamlFile(file), file, params);
  odometry::LaserOdometry odometry(params);
  const Eigen::Isometry3d T_base_laser(Eigen::Translation3d(0.0, 0.0, kRangingHeight_m));
  std::size_t next_wheels = 0, next_imu = 0;
  std::vector<Sensed> motions;
  for (const odometry::LaserScan& scan : scans) {
    const double end_s = scan.time_s + scan.sweep_s();
    odometry::MotionInputs& inputs = odometry.inputs();
    for (; wheels != nullptr && next_wheels < wheels->poses.size() && inputs.newestWheels_s() < end_s;
         ++next_wheels)
      inputs.addWheels(wheels->poses[next_wheels].first, wheels->poses[next_wheels].second);
    for (; gyro && next_imu < simulation.imu().size() && inputs.newestImu_s() < end_s; ++next_imu)
      inputs.addImu(simulation.imu()[next_imu], Eigen::Matrix3d::Identity());
    const odometry::LaserOdometryResult result = odometry.process(scan, T_base_laser);
    motions.push_back(
        motionAt(scan.time_s, end_s, inSpace(result.T_odom_base), spatialCovariance(result.pose_covariance)));
    motions.back().measurement.twist_covariance = spatialCovariance(result.twist_covariance);
  }
  return motions;
}

/// The visual odometry of one set of inputs.
class StereoRun {
 public:
  StereoRun(const ros_io::StereoProcessing& processing, const Eigen::Isometry3d& T_base_camera,
            const std::vector<ImuSample>* imu)
      : odometry_(odometry::loadOdometryConfig(ros_io::configFile("vo.yaml")), processing.calibration(),
                  {T_base_camera.linear(), Eigen::Matrix3d::Identity()}),
        base_(estimation::UncertaintyParams(), T_base_camera),
        imu_(imu) {}

  void add(const odometry::StereoFrame& frame, double available_s, std::vector<Sensed>& motions) {
    while (imu_ != nullptr && next_imu_ < imu_->size()) {
      odometry_.addImu((*imu_)[next_imu_]);
      if ((*imu_)[next_imu_++].time_s >= frame.right_time_s) break;
    }
    const estimation::BaseEstimate& estimate = base_.update(odometry_.process(frame), frame.left_time_s);
    motions.push_back(motionAt(frame.left_time_s, available_s + kVisionDelay_s, estimate.T_odom_base,
                               estimate.pose_covariance));
    motions.back().measurement.twist_covariance = estimate.twist_covariance;
  }

 private:
  odometry::WatchedOdometry odometry_;
  estimation::BaseOdometry base_;
  const std::vector<ImuSample>* imu_;
  std::size_t next_imu_ = 0;
};

void runStereo(const sim::Simulation& simulation, int threads, std::array<std::vector<Sensed>, 2>& motions) {
  const ros_io::SimulatedMessages messages(simulation, ros::Time(1000000000, 0));
  const ros_io::PairMessages first = messages.pair(0);
  const ros_io::StereoProcessing processing(first.left_info, first.right_info, {});
  const Eigen::Isometry3d T_base_camera = simulation.scenario().rig.T_base_camera();
  StereoRun alone(processing, T_base_camera, nullptr), aided(processing, T_base_camera, &simulation.imu());
  const auto& pairs = simulation.pairs();
  const auto batch = static_cast<std::size_t>(threads);
  for (std::size_t begin = 0; begin < pairs.size(); begin += batch) {
    std::vector<std::future<std::pair<cv::Mat, cv::Mat>>> rendered;
    for (std::size_t i = begin; i < std::min(begin + batch, pairs.size()); ++i) {
      rendered.push_back(std::async(std::launch::async, [&simulation, i] {
        return std::make_pair(simulation.image(sim::Side::kLeft, i), simulation.image(sim::Side::kRight, i));
      }));
    }
    for (std::size_t i = begin; i < begin + rendered.size(); ++i) {
      const auto [left, right] = rendered[i - begin].get();
      odometry::StereoFrame frame;
      frame.left_time_s = pairs[i].left_s;
      frame.right_time_s = pairs[i].right_s;
      frame.left = processing.rectifyLeft(left);
      frame.right = processing.rectifyRight(right);
      const double available_s = std::max(pairs[i].left_s, pairs[i].right_s);
      alone.add(frame, available_s, motions[0]);
      aided.add(frame, available_s, motions[1]);
    }
  }
}

}  // namespace

SensorRuns runSensors(const sim::Simulation& simulation, std::uint64_t seed, int threads) {
  SensorRuns runs;
  WheelRun wheels = runWheels(simulation);
  const sim::Scene scene(simulation.scenario().scene);
  const auto scans = simulateScans(scene, simulation.trajectory(), seed);
  for (std::size_t with = 0; with < runs.laser.size(); ++with)
    runs.laser[with] = runLaser(simulation, scans, with % 2 == 1 ? &wheels : nullptr, with >= 2);
  runs.wheels = std::move(wheels.speeds);
  runs.gyro = runGyro(simulation);
  runs.ranges = simulateRanges(scene, simulation.trajectory(), seed);
  runs.map = sim::wallMap(scene, simulation.scenario().scene.room, kRangingHeight_m);
  runStereo(simulation, threads, runs.stereo);
  return runs;
}

}  // namespace stereo_nav::tools
