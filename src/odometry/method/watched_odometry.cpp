#include "odometry/method/watched_odometry.h"

#include <cmath>
#include <utility>

namespace stereo_nav::odometry {
namespace {

/// A witness that has found no contradiction for so long is dismissed.
constexpr double kWitness_s = 8.0;

/// The image itself where it holds its memory; a copy where the memory is somebody else's, such as a
/// message's.
cv::Mat kept(const cv::Mat& image) {
  return image.u != nullptr ? image : image.clone();
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
  FrameResult result = odometry_->process(frame);
  if (!imu_problem_.empty()) result.T_start_camera = T_start_first_ * result.T_start_camera;
  if (!imu_problem_.empty() || imu_.empty()) return result;
  const bool has_previous = !previous_.left.empty();
  if (has_previous && isMeasured(result.state) && isMeasured(previous_state_))
    contradiction_.add(previous_.left_time_s, frame.left_time_s,
                       result.T_previous_current.linear().transpose());
  const bool is_suspicious = !isMeasured(result.state) || contradiction_.isSuspected(imu_);
  if (has_previous && !witness_ && !frame.right.empty() && is_suspicious) startWitness();
  if (witness_) {
    if (const auto taken_over = askWitness(frame)) return *taken_over;
  }
  remember(frame, result);
  return result;
}

void WatchedOdometry::remember(const StereoFrame& frame, const FrameResult& result) {
  previous_.left_time_s = frame.left_time_s;
  previous_.right_time_s = frame.right_time_s;
  previous_.readout_s = frame.readout_s;
  previous_.left = kept(frame.left);
  previous_.right = kept(frame.right);
  previous_state_ = result.state;
  T_start_previous_ = result.T_start_camera;
}

void WatchedOdometry::reset() {
  // An odometry made anew has nothing that could survive.
  *this = WatchedOdometry(config_, calibration_, axes_);
}

void WatchedOdometry::startWitness() {
  // The thesis' method is no judge: without IMU it follows whatever moves.
  const OdometryConfig config = config_.method() == Method::kStereo ? config_ : OdometryConfig();
  witness_.emplace(Witness{makeOdometry(config, calibration_, axes_.R_camera_imu()), ImuContradiction(axes_),
                           T_start_previous_, previous_.left_time_s});
  witness_->odometry->process(previous_);
}

FrameResult WatchedOdometry::takeOver(const StereoFrame& frame, FrameResult seen) {
  if (config_.method() == Method::kStereo) {
    odometry_ = std::move(witness_->odometry);
    T_start_first_ = witness_->T_start_first;
  } else {
    odometry_ = makeOdometry(config_, calibration_, axes_.R_camera_imu());
    T_start_first_ = T_start_previous_;
    seen = odometry_->process(frame);
  }
  witness_.reset();
  seen.T_start_camera = T_start_first_ * seen.T_start_camera;
  return seen;
}

std::optional<FrameResult> WatchedOdometry::askWitness(const StereoFrame& frame) {
  FrameResult result = witness_->odometry->process(frame);
  if (isMeasured(result.state)) {
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
