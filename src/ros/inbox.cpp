#include "ros/inbox.h"

#include <algorithm>
#include <utility>

#include "ros/imu_checks.h"

namespace stereo_nav::ros_io {
namespace {

/// Ten seconds at 400 Hz, which is the length of the odometry's own history.
constexpr std::size_t kMaxImuSamples = 4000;

}  // namespace

void InboxParams::describe(ParameterVisitor& visitor) {
  visitor.integer("capacity", capacity, {1, 100}, "frames",
                  "complete frames that wait for the odometry; when there are more, the oldest is dropped");
  visitor.real(
      "imu_wait_s", imu_wait_s, {0.0, 1.0}, "s",
      "how long a frame waits for IMU messages up to its stamp, counted from its left image's arrival");
}

void Inbox::push(FrameMessages frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  frames_.push_back(std::move(frame));
  if (frames_.size() > static_cast<std::size_t>(params_.capacity)) {
    const bool after_jump = frames_.front().after_jump;
    frames_.pop_front();
    frames_.front().after_jump |= after_jump;
    ++frames_dropped_;
  }
  arrived_.notify_one();
}

void Inbox::addImu(const ImuSample& sample) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (imu_seen_ && sample.time_s <= imu_newest_s_) {
    if (imu_newest_s_ - sample.time_s < kClockJump_s) {
      ++imu_dropped_;
      return;
    }
    imu_dropped_ += imu_.size();
    imu_.clear();
  }
  imu_seen_ = true;
  imu_newest_s_ = sample.time_s;
  imu_.push_back(sample);
  if (imu_.size() > kMaxImuSamples) {
    imu_.pop_front();
    ++imu_dropped_;
  }
  if (!frames_.empty()) arrived_.notify_one();
}

/// The time at which a frame is handed out even without the IMU samples that it waits for.
SteadyTime Inbox::deadline(const FrameMessages& frame) const {
  const std::chrono::duration<double> patience(params_.imu_wait_s);
  return frame.arrival + std::chrono::duration_cast<SteadyTime::duration>(patience);
}

std::optional<Inbox::Work> Inbox::take(SteadyTime now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return takeLocked(now);
}

std::optional<Inbox::Work> Inbox::takeLocked(SteadyTime now) {
  if (frames_.empty()) return std::nullopt;
  const FrameMessages& next = frames_.front();
  const double needed_s = std::max(next.left_stamp, next.right_stamp).toSec();
  const bool covered = !params_.wait_for_imu || (imu_seen_ && imu_newest_s_ >= needed_s);
  // An IMU with another clock will not cover the frame however long it waits.
  const bool hopeless = imu_seen_ && imu_newest_s_ < needed_s - kImuOffClock_s;
  if (!covered && !hopeless && now < deadline(next)) return std::nullopt;

  Work work;
  work.frame = next;
  work.imu_late = !covered;
  frames_without_imu_ += covered ? 0 : 1;
  frames_.pop_front();
  while (!imu_.empty()) {
    const double time_s = imu_.front().time_s;
    work.imu.push_back(imu_.front());
    imu_.pop_front();
    if (time_s >= needed_s) break;
  }
  return work;
}

std::optional<Inbox::Work> Inbox::waitAndTake() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stopped_) {
    if (auto work = takeLocked(std::chrono::steady_clock::now())) return work;
    if (frames_.empty()) {
      arrived_.wait(lock);
    } else {
      arrived_.wait_until(lock, deadline(frames_.front()));
    }
  }
  return std::nullopt;
}

void Inbox::stop() {
  const std::lock_guard<std::mutex> lock(mutex_);
  stopped_ = true;
  arrived_.notify_all();
}

std::uint64_t Inbox::framesDropped() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return frames_dropped_;
}

std::uint64_t Inbox::framesWithoutImu() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return frames_without_imu_;
}

std::uint64_t Inbox::imuDropped() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return imu_dropped_;
}

}  // namespace stereo_nav::ros_io
