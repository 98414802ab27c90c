#include "odometry/method/watched_odometry.h"

#include <utility>

namespace stereo_nav::odometry {
namespace {

/// A witness that has found no contradiction for so long is dismissed.
constexpr double kWitness_s = 8.0;

bool isTracked(const FrameResult& result) {
  return result.state == State::kTracking;
}

}  // namespace

WatchedOdometry::WatchedOdometry(const OdometryConfig& config, const vision::StereoCalibration& calibration,
                                 const SensorAxes& axes)
    : config_(config),
      calibration_(calibration),
      axes_(axes),
      odometry_(makeOdometry(config, calibration, axes.R_camera_imu())),
      contradiction_(axes) {}

void WatchedOdometry::addImu(const ImuSample& sample) {
  if (!imu_problem_.empty()) return;
  imu_.add(sample);
  odometry_->addImu(sample);
}

FrameResult WatchedOdometry::process(const StereoFrame& frame) {
  if (witness_took_over_) {
    FrameResult result = witness_->odometry->process(frame);
    result.T_start_camera = witness_->T_start_first * result.T_start_camera;
    return result;
  }
  FrameResult result = odometry_->process(frame);
  if (imu_.empty()) return result;
  const bool has_previous = !previous_.left.empty();
  if (has_previous && isTracked(result) && previous_result_.state != State::kLost)
    contradiction_.add(previous_.left_time_s, frame.left_time_s,
                       result.T_previous_current.linear().transpose());
  if (has_previous && !witness_ && !frame.right.empty() && isSuspicious(result)) startWitness();
  if (witness_) {
    if (const auto taken_over = askWitness(frame)) return *taken_over;
  }
  previous_ = frame;
  previous_.left = frame.left.clone();
  previous_.right = frame.right.clone();
  previous_.disparity = frame.disparity.clone();
  previous_result_ = result;
  return result;
}

void WatchedOdometry::reset() {
  // An odometry made anew has nothing that could survive.
  *this = WatchedOdometry(config_, calibration_, axes_);
}

bool WatchedOdometry::isSuspicious(const FrameResult& result) const {
  return result.state == State::kLost || contradiction_.isSuspected(imu_);
}

void WatchedOdometry::startWitness() {
  // The thesis' method is no judge: without IMU it follows whatever moves.
  const OdometryConfig config = config_.method() == Method::kStereo ? config_ : OdometryConfig();
  witness_.emplace(Witness{makeOdometry(config, calibration_, axes_.R_camera_imu()), ImuContradiction(axes_),
                           previous_result_.T_start_camera, previous_.left_time_s});
  witness_->odometry->process(previous_);
}

FrameResult WatchedOdometry::takeOver(const StereoFrame& frame, FrameResult seen) {
  witness_took_over_ = true;
  if (config_.method() != Method::kStereo) {
    witness_->odometry = makeOdometry(config_, calibration_, axes_.R_camera_imu());
    witness_->T_start_first = previous_result_.T_start_camera;
    witness_->odometry->process(previous_);
    seen = witness_->odometry->process(frame);
  }
  seen.T_start_camera = witness_->T_start_first * seen.T_start_camera;
  return seen;
}

std::optional<FrameResult> WatchedOdometry::askWitness(const StereoFrame& frame) {
  FrameResult result = witness_->odometry->process(frame);
  if (isTracked(result)) {
    witness_->contradiction.add(previous_.left_time_s, frame.left_time_s,
                                result.T_previous_current.linear().transpose());
  }
  if (const auto problem = witness_->contradiction.find(imu_)) {
    imu_problem_ = *problem;
    return takeOver(frame, std::move(result));
  }
  if (frame.left_time_s > witness_->since_s + kWitness_s) {
    witness_.reset();
    contradiction_.clear();
  }
  return std::nullopt;
}

}  // namespace stereo_nav::odometry
