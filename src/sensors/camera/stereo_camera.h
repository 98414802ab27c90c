#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>

#include "sensors/camera/camera_worker.h"
#include "sensors/camera/clock_beat.h"
#include "sensors/camera/left_right_pairer.h"

namespace stereo_nav::camera {

/// What the two cameras are asked for, and how their frames are paired (`max_time_offset_s`: largest time
/// between the frames of a pair).
struct StereoConfig {
  CameraConfig left;
  CameraConfig right;
  double max_time_offset_s = 0.02;
  bool match_exposure = false;  ///< the right camera follows the left one's exposure and gain
};

/// A pair with what is known about the pairing at that time.
struct StereoImages {
  FramePair pair;
  std::uint64_t pairs_dropped = 0;  ///< frames left without a partner, both cameras
  double time_offset_rate = 0.0;    ///< s/s; NaN until known
};

/// A snapshot for diagnostics.
struct StereoStatus {
  CameraStatus left;
  CameraStatus right;
  PairerCounts pairing;
  std::uint64_t delivered_late = 0;  ///< pairs overtaken by newer ones while the receiver was busy
  double pair_rate_hz = 0.0;
  double max_time_offset_s = 0.0;  ///< as it is set now
  double time_offset_s = 0.0;      ///< of the latest pair
  double time_offset_rate = 0.0;   ///< s/s; NaN until known
  double latency_s = 0.0;          ///< of the latest pair, from dequeuing its later image to handing it on
};

/// Two cameras, each with a thread that captures and decodes. The thread whose image completes a pair hands
/// it to the receiver itself, so that no other thread has to be woken. When a receiver is slow, that camera
/// goes on with its newest image afterwards. Of the pairs that the other camera completes meanwhile at most
/// kQueueLength wait; older ones are dropped.
class StereoCamera {
 public:
  /// Called on a camera's thread, one call at a time, in the order of the pairs.
  using PairSink = std::function<void(StereoImages)>;

  StereoCamera(const StereoConfig& config, Kernel& kernel, const DeviceFinder& finder, PairSink on_pair,
               Log log);
  ~StereoCamera();

  void start();
  /// Returns when both threads have ended and no pair is on its way.
  void stop();
  StereoStatus status() const;
  CameraWorker& left() { return left_; }
  CameraWorker& right() { return right_; }
  void setMaxTimeOffset(double max_time_offset_s);

 private:
  static constexpr std::size_t kQueueLength = 2;

  void take(Side side, Frame frame);
  void cameraStarted(Side side);
  void enqueue(FramePair pair);
  void deliverPairs(std::unique_lock<std::mutex>& lock);
  void matchExposure();

  Kernel& kernel_;
  const bool match_exposure_;
  const PairSink on_pair_;
  const Log log_;

  mutable std::mutex mutex_;
  LeftRightPairer pairer_;
  ClockBeat beat_;
  FrameRate pair_rate_;
  std::deque<StereoImages> queue_;
  std::uint64_t delivered_late_ = 0;
  double latency_s_ = 0.0;
  double time_offset_s_ = 0.0;
  bool delivering_ = false;  ///< one of the threads is in deliverPairs()

  std::optional<std::int32_t> matched_exposure_;
  std::optional<std::int32_t> matched_gain_;
  bool warned_of_unknown_exposure_ = false;

  CameraWorker left_;
  CameraWorker right_;
};

}  // namespace stereo_nav::camera
