#include "sensors/camera/stereo_camera.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace stereo_nav::camera {
namespace {

std::int64_t nanoseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(seconds * 1e9));
}

}  // namespace

StereoCamera::StereoCamera(const StereoConfig& config, Kernel& kernel, const DeviceFinder& finder,
                           PairSink on_pair, Log log)
    : kernel_(kernel),
      match_exposure_(config.match_exposure),
      on_pair_(std::move(on_pair)),
      log_(log),
      pairer_(nanoseconds(1.0 / config.left.format.rate_hz), nanoseconds(config.max_time_offset_s)),
      left_(
          config.left, kernel, finder, [this](Frame frame) { take(Side::kLeft, std::move(frame)); },
          [this] { cameraStarted(Side::kLeft); }, log),
      right_(
          config.right, kernel, finder, [this](Frame frame) { take(Side::kRight, std::move(frame)); },
          [this] { cameraStarted(Side::kRight); }, log) {}

StereoCamera::~StereoCamera() {
  stop();
}

void StereoCamera::start() {
  left_.start();
  right_.start();
}

void StereoCamera::stop() {
  left_.stop();
  right_.stop();
}

void StereoCamera::setMaxTimeOffset(double max_time_offset_s) {
  const std::lock_guard<std::mutex> lock(mutex_);
  pairer_.setMaxTimeOffset(nanoseconds(max_time_offset_s));
}

void StereoCamera::cameraStarted(Side side) {
  const std::lock_guard<std::mutex> lock(mutex_);
  pairer_.restart(side);
}

void StereoCamera::take(Side side, Frame frame) {
  std::unique_lock<std::mutex> lock(mutex_);
  auto pair = pairer_.push(side, std::move(frame));
  if (!pair) return;
  enqueue(std::move(*pair));
  if (!delivering_) deliverPairs(lock);
}

void StereoCamera::enqueue(FramePair pair) {
  beat_.add(pair.left.time_ns, pair.timeOffset_ns(), pairer_.period_ns());
  time_offset_s_ = 1e-9 * static_cast<double>(pair.timeOffset_ns());
  const auto& dropped = pairer_.counts().without_partner;
  queue_.push_back({std::move(pair), dropped[0] + dropped[1], beat_.timeOffsetRate()});
  if (queue_.size() <= kQueueLength) return;
  queue_.pop_front();
  ++delivered_late_;
}

/// Delivers also the pairs that the other camera completes meanwhile, so that pairs keep their order.
void StereoCamera::deliverPairs(std::unique_lock<std::mutex>& lock) {
  delivering_ = true;
  while (!queue_.empty()) {
    StereoImages images = std::move(queue_.front());
    queue_.pop_front();
    const std::int64_t now_ns = kernel_.monotonicNow();
    latency_s_ = 1e-9 * static_cast<double>(
                            now_ns - std::max(images.pair.left.dequeued_ns, images.pair.right.dequeued_ns));
    pair_rate_.add(now_ns);
    lock.unlock();
    on_pair_(std::move(images));
    if (match_exposure_) matchExposure();
    lock.lock();
  }
  delivering_ = false;
}

void StereoCamera::matchExposure() {
  const CameraStatus left = left_.status();
  if (left.exposure_unknown && !std::exchange(warned_of_unknown_exposure_, true)) {
    log_(Severity::kWarning,
         "match_exposure: the left camera has not told the exposure time that it chose; the right camera "
         "follows as soon as it does. If the images stay different, set exposure_ms");
  }
  if (left.exposure && left.exposure != matched_exposure_) {
    matched_exposure_ = left.exposure;
    right_.setControl("auto_exposure", V4L2_EXPOSURE_MANUAL);
    right_.setControl("exposure_time_absolute", *left.exposure);
  }
  if (left.gain && left.gain != matched_gain_) {
    matched_gain_ = left.gain;
    right_.setControl("gain", *left.gain);
  }
}

StereoStatus StereoCamera::status() const {
  StereoStatus status;
  status.left = left_.status();
  status.right = right_.status();
  const std::lock_guard<std::mutex> lock(mutex_);
  status.pairing = pairer_.counts();
  status.delivered_late = delivered_late_;
  status.pair_rate_hz = pair_rate_.rate_hz(kernel_.monotonicNow());
  status.max_time_offset_s = 1e-9 * static_cast<double>(pairer_.maxTimeOffset_ns());
  status.time_offset_s = time_offset_s_;
  status.time_offset_rate = beat_.timeOffsetRate();
  status.latency_s = latency_s_;
  return status;
}

}  // namespace stereo_nav::camera
