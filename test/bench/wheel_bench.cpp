// Cost of one update of the wheel odometry: dead wheels with an IMU, and a swerve drive of four modules.
#include <benchmark/benchmark.h>

#include <cmath>

#include "kinematics/layouts.h"
#include "odometry/wheel/wheel_odometry.h"

namespace stereo_nav::odometry {
namespace {

void run(benchmark::State& state, const kinematics::DriveParams& drive, bool steered) {
  WheelOdometryParams params;
  params.drive = drive;
  WheelOdometry odometry(params);
  WheelSample sample;
  sample.pulses.assign(drive.wheels.size(), 0);
  if (steered) sample.steering_rad.assign(drive.wheels.size(), 0.0);
  for (auto _ : state) {
    sample.time_s += 0.01;
    sample.yaw_rad = 0.0;
    for (std::size_t i = 0; i < sample.pulses.size(); ++i) sample.pulses[i] += 43;
    for (auto& angle : sample.steering_rad) angle = 0.1 * std::sin(sample.time_s);
    benchmark::DoNotOptimize(odometry.process(sample));
  }
}

void deadWheels(benchmark::State& state) {
  run(state, kinematics::deadWheels(0.5377, 0.2745, 0.0296028), false);
}

void mecanum(benchmark::State& state) {
  run(state, kinematics::mecanumDrive(0.15, 0.12, 0.05), false);
}

void swerveOfFour(benchmark::State& state) {
  run(state, kinematics::swerveDrive({{0.2, 0.2}, {0.2, -0.2}, {-0.2, 0.2}, {-0.2, -0.2}}, 0.05), true);
}

BENCHMARK(deadWheels);
BENCHMARK(mecanum);
BENCHMARK(swerveOfFour);

}  // namespace
}  // namespace stereo_nav::odometry

BENCHMARK_MAIN();
