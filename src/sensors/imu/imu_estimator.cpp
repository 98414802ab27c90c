#include "sensors/imu/imu_estimator.h"

namespace stereo_nav::imu {

ImuEstimator::ImuEstimator(const AttitudeParams& attitude, const ImuCalibration& calibration,
                           double rate_window_s)
    : calibration_(calibration), filter_(makeAttitudeFilter(attitude)), rate_(rate_window_s) {}

ImuEstimate ImuEstimator::process(const ImuReading& reading) {
  ImuEstimate estimate =
      reading.angles ? fromAngles(*reading.angles, reading.time_s) : fromRaw(*reading.raw, reading.time_s);
  if (estimate.q_world_imu) {
    last_heading_rad_ = heading(*estimate.q_world_imu);
    estimate.q_world_imu =
        Eigen::AngleAxisd(-yaw_offset_rad_, Eigen::Vector3d::UnitZ()) * *estimate.q_world_imu;
  }
  return estimate;
}

void ImuEstimator::resetYaw() {
  yaw_offset_rad_ = last_heading_rad_;
}

void ImuEstimator::setGyroBias(const Eigen::Vector3d& bias) {
  calibration_.gyroscope_bias.value = bias;
  filter_->forgetBias();
}

ImuEstimate ImuEstimator::fromAngles(const ModuleAngles& angles, double time_s) {
  ImuEstimate estimate;
  estimate.q_world_imu = orientationFromModule(angles);
  estimate.angular_velocity = rate_.update(time_s, *estimate.q_world_imu);
  return estimate;
}

ImuEstimate ImuEstimator::fromRaw(const RawMeasurement& measured, double time_s) {
  const InertialSample sample = calibration_.apply(measured, time_s);
  filter_->update(sample);
  ImuEstimate estimate;
  if (filter_->initialised()) estimate.q_world_imu = filter_->q_world_imu();
  estimate.angular_velocity = sample.angular_velocity - filter_->gyroBias();
  estimate.linear_acceleration = sample.linear_acceleration;
  return estimate;
}

}  // namespace stereo_nav::imu
