#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "stereo_nav/capture/camera_worker.h"
#include "stereo_nav/capture/clock_beat.h"
#include "stereo_nav/capture/pairer.h"

namespace stereo_nav::capture {

/// What the two cameras are asked for, and how their frames pair (`max_skew_s`: largest time between them).
struct StereoConfig {
  CameraConfig left;
  CameraConfig right;
  double max_skew_s = 0.02;
  bool match_exposure = false;  ///< the right camera follows the left one's exposure and gain
};

/// A pair with what is known about the pairing at that time.
struct StereoImages {
  FramePair pair;
  std::uint64_t pairs_dropped = 0;  ///< frames left without a partner, both cameras
  double skew_rate = 0.0;           ///< s/s; NaN until known
};

/// A snapshot for diagnostics.
struct StereoStatus {
  CameraStatus left;
  CameraStatus right;
  PairerCounts pairing;
  std::uint64_t delivered_late = 0;  ///< pairs overtaken by newer ones while the receiver was busy
  double pair_rate_hz = 0.0;
  double max_skew_s = 0.0;  ///< as it is set now
  double skew_s = 0.0;      ///< of the latest pair
  double skew_rate = 0.0;   ///< s/s; NaN until known
  double latency_s = 0.0;   ///< of the latest pair, from dequeuing its later image to handing it on
};

/// Two cameras, three threads: each camera has one, which captures and decodes; the third hands pairs to the
/// receiver, so that a slow receiver disturbs no camera. At most kQueueLength pairs wait; older ones go.
class StereoCamera {
 public:
  using PairSink = std::function<void(StereoImages)>;

  StereoCamera(const StereoConfig& config, Kernel& kernel, const DeviceFinder& finder, PairSink on_pair,
               Log log);
  ~StereoCamera();

  void start();
  void stop();
  StereoStatus status() const;
  CameraWorker& left() { return left_; }
  CameraWorker& right() { return right_; }
  void setMaxSkew(double max_skew_s);

 private:
  static constexpr std::size_t kQueueLength = 2;

  void take(Side side, Frame frame);
  void cameraStarted(Side side);
  void deliverPairs();
  void matchExposure();

  Kernel& kernel_;
  const bool match_exposure_;
  const std::int64_t nominal_period_ns_;
  const PairSink on_pair_;

  mutable std::mutex mutex_;
  std::condition_variable pair_ready_;
  Pairer pairer_;
  ClockBeat beat_;
  FrameRate pair_rate_;
  std::deque<StereoImages> queue_;
  std::uint64_t delivered_late_ = 0;
  double latency_s_ = 0.0;
  double skew_s_ = 0.0;
  bool stopping_ = false;

  std::optional<std::int32_t> matched_exposure_;
  std::optional<std::int32_t> matched_gain_;

  CameraWorker left_;
  CameraWorker right_;
  std::thread delivery_;
};

}  // namespace stereo_nav::capture
