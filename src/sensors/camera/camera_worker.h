#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "sensors/camera/backoff.h"
#include "sensors/camera/controls.h"
#include "sensors/camera/device_finder.h"
#include "sensors/camera/driver_clock.h"
#include "sensors/camera/exposure_reader.h"
#include "sensors/camera/frame.h"
#include "sensors/camera/frame_rate.h"
#include "sensors/camera/sequence_counter.h"
#include "sensors/camera/v4l2_device.h"
#include "sensors/camera/wanted_controls.h"

namespace stereo_nav::camera {

enum class Severity { kInfo, kWarning, kError };
using Log = std::function<void(Severity, const std::string&)>;

/// What one camera is asked for.
struct CameraConfig {
  std::string name;    ///< for messages: "left" or "right"
  std::string device;  ///< /dev/videoN, a link to one, or a bus_info
  FormatRequest format;
  Encoding encoding = Encoding::kBgr8;
  std::vector<ControlSetting> controls;
  int buffers = 4;
  double stall_timeout_s = 1.0;    ///< the camera is opened again after this time without a frame
  double rolling_shutter_s = 0.0;  ///< time from the first row of an image to the last one
};

enum class CameraState { kClosed, kRetrying, kStreaming };

/// A snapshot for diagnostics. Counts begin at the start of the program.
struct CameraStatus {
  CameraState state = CameraState::kClosed;
  FoundDevice device;
  ActiveFormat format;
  double rate_hz = 0.0;               ///< delivered, over the last second
  std::uint64_t frames = 0;           ///< decoded and handed on
  std::uint64_t lost = 0;             ///< gaps in the driver's counter
  std::uint64_t flagged_broken = 0;   ///< buffers that the driver flagged as broken
  std::uint64_t undecodable = 0;      ///< corrupt JPEG or too little data
  std::uint64_t skipped = 0;          ///< good frames that were dropped because a newer one was there already
  std::uint64_t stalls = 0;           ///< how often no frame came within the time-out
  std::uint64_t reconnections = 0;    ///< how often frames came again after a failure
  std::uint64_t failed_attempts = 0;  ///< openings that failed
  std::string problem;                ///< the latest failure; empty while all is well
  std::string clock_warning;          ///< doubts about the driver's stamps
  std::vector<std::string> control_warnings;
  std::optional<std::int32_t> exposure;  ///< exposure_time_absolute, 100 us; if reported
  std::optional<std::int32_t> gain;
  bool exposure_unknown = false;  ///< automatic, and the camera does not report the time that it chose
  double decode_time_s = 0.0;     ///< of the latest frame; taking it from the driver is not included
};

/// One camera and its thread. The thread opens and configures the camera, captures the newest frames, decodes
/// them and hands them on. After any failure it closes the camera, waits (a little longer each time), and
/// looks for the camera at its port again.
class CameraWorker {
 public:
  /// Called on the worker's thread with every good frame.
  using FrameSink = std::function<void(Frame)>;
  /// Called on the worker's thread when frames come for the first time or again after a failure.
  using StartSink = std::function<void()>;

  CameraWorker(CameraConfig config, Kernel& kernel, DeviceFinder finder, FrameSink on_frame,
               StartSink on_start, Log log);
  ~CameraWorker();
  CameraWorker(const CameraWorker&) = delete;
  CameraWorker& operator=(const CameraWorker&) = delete;

  void start();
  /// Returns when the thread has ended, which takes at most one poll (100 ms) and one decode.
  void stop();

  CameraStatus status() const;
  /// The worker's thread applies the value soon, and again whenever the camera is opened.
  void setControl(const std::string& name, std::int32_t value);

 private:
  void run();
  FoundDevice locate();
  void openAndStream();
  void stream(V4l2Device& device);
  std::optional<LentBuffer> takeNewest(V4l2Device& device);
  void deliver(V4l2Device& device, const LentBuffer& buffer);
  void applyControls(V4l2Device& device, const std::vector<ControlSetting>& settings);
  void readExposure(V4l2Device& device);
  void noteFailure(const CaptureError& error);
  void noteUndecodable(const std::string& problem, std::int64_t now_ns);
  void noteFirstFrame();
  void warnOfAnotherRate();
  bool sleepUnlessStopped(Backoff::Duration duration);
  void update(const std::function<void(CameraStatus&)>& change);

  const CameraConfig config_;
  Kernel& kernel_;
  const DeviceFinder finder_;
  const FrameSink on_frame_;
  const StartSink on_start_;
  const Log log_;

  // Used by the thread only.
  std::optional<FoundDevice> seen_before_;
  ActiveFormat format_;
  DecodedImage prepared_;  ///< memory for the next image
  DriverClock clock_;
  SequenceCounter sequence_;
  FrameRate rate_;
  Backoff backoff_;
  std::int64_t next_exposure_reading_ns_ = 0;
  std::int64_t next_undecodable_log_ns_ = 0;
  std::optional<double> exposure_s_;
  ExposureReader exposure_reader_;
  std::string logged_problem_;
  std::uint64_t starts_ = 0;
  bool frames_flow_ = false;

  // Shared with callers.
  mutable std::mutex mutex_;
  std::condition_variable stop_requested_;
  bool stopping_ = false;
  CameraStatus status_;
  WantedControls wanted_controls_;

  std::thread thread_;
};

}  // namespace stereo_nav::camera
