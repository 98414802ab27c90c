#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "ros/frame_synchroniser.h"
#include "stereo_nav/core/imu_sample.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::ros_io {

struct InboxParams {
  int capacity = 5;
  double imu_wait_s = 0.1;
  bool wait_for_imu = true;  ///< not a parameter: follows from the IMU topic that is used

  void describe(ParameterVisitor& visitor);
};

/// Queue between the callbacks, which must return quickly, and the thread that runs the odometry. A frame is
/// handed out when an IMU sample at or after both its stamps has arrived (so that the attitude at the image
/// can be interpolated), or when it has waited `imu_wait_s` for one. It does not wait for an IMU whose stamps
/// lie seconds before the frame's: that one has another clock. Thread-safe.
///
/// Drop rule: when more than `capacity` frames wait, the oldest is dropped and counted.
class Inbox {
 public:
  struct Work {
    FrameMessages frame;
    std::vector<ImuSample> imu;  ///< samples since the last hand-out, up to the first one after the frame
    bool imu_late = false;       ///< the frame was handed out without the samples it waited for
  };

  explicit Inbox(const InboxParams& params) : params_(params) {}

  void push(FrameMessages frame);
  /// Adds a sample. One that is much older than the newest starts a new epoch (a bag that loops); one that is
  /// a little older is dropped.
  void addImu(const ImuSample& sample);

  /// Takes the next frame, if it is ready at `now`.
  std::optional<Work> take(SteadyTime now);
  /// Waits for the next frame; returns nothing after stop().
  std::optional<Work> waitAndTake();
  void stop();

  std::uint64_t framesDropped() const;
  std::uint64_t framesWithoutImu() const;
  std::uint64_t imuDropped() const;

 private:
  std::optional<Work> takeLocked(SteadyTime now);
  SteadyTime deadline(const FrameMessages& frame) const;

  const InboxParams params_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<FrameMessages> frames_;
  std::deque<ImuSample> imu_;
  double imu_newest_s_ = 0.0;
  bool imu_seen_ = false;
  bool stopped_ = false;
  std::uint64_t frames_dropped_ = 0;
  std::uint64_t frames_without_imu_ = 0;
  std::uint64_t imu_dropped_ = 0;
};

}  // namespace stereo_nav::ros_io
