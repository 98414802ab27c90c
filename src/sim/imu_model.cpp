#include "sim/imu_model.h"

#include <cmath>

#include "core/angles.h"
#include "core/roll_pitch_yaw.h"
#include "sim/random.h"

namespace stereo_nav::sim {
namespace {

const Eigen::Vector3d kGravity_world(0.0, 0.0, -9.81);

Eigen::Vector3d normalVector(RandomStream& random) {
  const double x = random.normal(), y = random.normal();
  return {x, y, random.normal()};
}

double quantise(double value, double step) {
  return step > 0.0 ? step * std::round(value / step) : value;
}

ImuSample thesisSample(const ImuParams& params, const BaseState& state, double time_s, RandomStream& random) {
  const RollPitchYaw truth = RollPitchYaw::of(state.T_world_base.linear());
  Eigen::Vector3d angles_deg = Eigen::Vector3d(truth.yaw, truth.pitch, truth.roll) / kRadPerDeg;
  angles_deg += params.angle_noise_deg * normalVector(random);
  angles_deg.x() += params.power_on_yaw_deg + params.yaw_drift_dps * time_s;
  for (double& angle : angles_deg) angle = quantise(angle, params.quantisation_deg);
  ImuSample sample;
  sample.q_world_imu = RollPitchYaw::fromDegrees(angles_deg.z(), angles_deg.y(), angles_deg.x()).quaternion();
  return sample;
}

Eigen::Vector3d specificForce(const BaseState& state) {
  return state.T_world_base.linear().transpose() * (state.acceleration_world - kGravity_world);
}

ImuSample rawSample(const ImuParams& params, const BaseState& state, const Eigen::Vector3d& gyro_bias_dps,
                    const Eigen::Vector3d& accel_bias, RandomStream& random) {
  const double root_rate = std::sqrt(params.rate_hz);  // white noise of a density, sampled
  ImuSample sample;
  const Eigen::Vector3d gyro_error =
      gyro_bias_dps + params.gyro_noise_dps_rthz * root_rate * normalVector(random);
  sample.angular_velocity = state.angular_velocity_base + kRadPerDeg * gyro_error;
  sample.linear_acceleration =
      specificForce(state) + accel_bias + params.accel_noise_mps2_rthz * root_rate * normalVector(random);
  return sample;
}

ImuSample perfectSample(const BaseState& state) {
  ImuSample sample;
  sample.q_world_imu = Eigen::Quaterniond(state.T_world_base.linear());
  sample.angular_velocity = state.angular_velocity_base;
  sample.linear_acceleration = specificForce(state);
  return sample;
}

}  // namespace

ImuModel::ImuModel(const ImuParams& params, std::uint64_t seed)
    : params_(params),
      random_(streamKey(seed, Stream::kImu)),
      gyro_bias_dps_(params.gyro_bias_dps * normalVector(random_)),
      accel_bias_(params.accel_bias_mps2 * normalVector(random_)) {}

ImuSample ImuModel::sample(const BaseState& state, double time_s) {
  ImuSample sample;
  switch (params_.kind) {
    case ImuKind::kNone:
      break;
    case ImuKind::kPerfect:
      sample = perfectSample(state);
      break;
    case ImuKind::kThesis:
      sample = thesisSample(params_, state, time_s, random_);
      break;
    case ImuKind::kRaw:
      gyro_bias_dps_ += params_.gyro_walk_dps2_rthz / std::sqrt(params_.rate_hz) * normalVector(random_);
      sample = rawSample(params_, state, gyro_bias_dps_, accel_bias_, random_);
      break;
  }
  sample.time_s = time_s + latency_s();
  return sample;
}

std::vector<ImuSample> simulateImu(const ImuParams& params, const Trajectory& trajectory, double duration_s,
                                   std::uint64_t seed) {
  std::vector<ImuSample> samples;
  if (params.kind == ImuKind::kNone) return samples;
  ImuModel model(params, seed);
  const auto count = static_cast<std::size_t>(std::floor(duration_s * params.rate_hz)) + 1;
  for (std::size_t i = 0; i < count; ++i) {
    const double time_s = static_cast<double>(i) / params.rate_hz;
    samples.push_back(model.sample(trajectory.state(time_s), time_s));
  }
  return samples;
}

void ImuParams::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "kind", kind,
            {{"none", ImuKind::kNone},
             {"perfect", ImuKind::kPerfect},
             {"thesis", ImuKind::kThesis},
             {"raw", ImuKind::kRaw}},
            "perfect: attitude and rates without error; thesis: three angles, yaw drifting; raw: gyro and "
            "accelerometer");
  visitor.real("rate_hz", rate_hz, {1.0, 2000.0}, "Hz", "samples per second");
  visitor.real("latency_ms", latency_ms, {0.0, 200.0}, "ms", "stamps are this late; not for a perfect one");
  visitor.real("yaw_drift_dps", yaw_drift_dps, {-10.0, 10.0}, "deg/s", "thesis: drift of the yaw angle");
  visitor.real("power_on_yaw_deg", power_on_yaw_deg, {-180.0, 180.0}, "deg",
               "thesis: yaw shown at the start");
  visitor.real("angle_noise_deg", angle_noise_deg, {0.0, 10.0}, "deg",
               "thesis: standard deviation of each angle");
  visitor.real("quantisation_deg", quantisation_deg, {0.0, 10.0}, "deg", "thesis: step of the angles");
  visitor.real("gyro_bias_dps", gyro_bias_dps, {0.0, 10.0}, "deg/s",
               "raw: standard deviation of the bias of each axis");
  visitor.real("gyro_noise_dps_rthz", gyro_noise_dps_rthz, {0.0, 1.0}, "deg/s/sqrt(Hz)",
               "raw: noise density");
  visitor.real("gyro_walk_dps2_rthz", gyro_walk_dps2_rthz, {0.0, 1.0}, "deg/s^2/sqrt(Hz)",
               "raw: random walk of the bias");
  visitor.real("accel_bias_mps2", accel_bias_mps2, {0.0, 5.0}, "m/s^2",
               "raw: standard deviation of the bias of each axis");
  visitor.real("accel_noise_mps2_rthz", accel_noise_mps2_rthz, {0.0, 1.0}, "m/s^2/sqrt(Hz)",
               "raw: noise density");
}

}  // namespace stereo_nav::sim
