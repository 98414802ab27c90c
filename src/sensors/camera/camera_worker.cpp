#include "sensors/camera/camera_worker.h"

#include <cmath>
#include <sstream>
#include <utility>

namespace stereo_nav::camera {
namespace {

constexpr int kPoll_ms = 100;
constexpr std::int64_t kExposureInterval_ns = 500'000'000;
constexpr std::int64_t kLogInterval_ns = 10'000'000'000;
constexpr double kRateTolerance = 0.02;  // 30 Hz may be 30000/1001

}  // namespace

CameraWorker::CameraWorker(CameraConfig config, Kernel& kernel, DeviceFinder finder, FrameSink on_frame,
                           StartSink on_start, Log log)
    : config_(std::move(config)),
      kernel_(kernel),
      finder_(std::move(finder)),
      on_frame_(std::move(on_frame)),
      on_start_(std::move(on_start)),
      log_(std::move(log)),
      clock_(kernel),
      wanted_controls_(config_.controls) {}

CameraWorker::~CameraWorker() {
  stop();
}

void CameraWorker::start() {
  if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
}

void CameraWorker::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  stop_requested_.notify_all();
  if (thread_.joinable()) thread_.join();
}

CameraStatus CameraWorker::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return status_;
}

void CameraWorker::update(const std::function<void(CameraStatus&)>& change) {
  const std::lock_guard<std::mutex> lock(mutex_);
  change(status_);
}

void CameraWorker::run() {
  do {
    frames_flow_ = false;
    try {
      openAndStream();
    } catch (const CaptureError& error) {
      noteFailure(error);
    }
  } while (sleepUnlessStopped(backoff_.next()));
  update([](CameraStatus& status) { status.state = CameraState::kClosed; });
}

/// Looks at the port of the camera once the camera was seen there. A name from /dev/v4l/by-id means the
/// camera itself, at whatever port it is now.
FoundDevice CameraWorker::locate() {
  const bool by_id = config_.device.find("/by-id/") != std::string::npos;
  return seen_before_ && !by_id ? finder_.findAgain(*seen_before_) : finder_.find(config_.device);
}

void CameraWorker::openAndStream() {
  const FoundDevice found = locate();
  V4l2Device device(kernel_, found.path);
  format_ = device.configure(config_.format);
  update([](CameraStatus& status) { status.control_warnings.clear(); });
  applyControls(device, wanted_controls_.takeAll());
  device.startStreaming(config_.buffers);
  seen_before_ = found;
  update([&](CameraStatus& status) {
    status.device = found;
    status.format = format_;
  });
  clock_.reset();
  sequence_.restart();
  rate_.restart();
  next_exposure_reading_ns_ = 0;
  exposure_reader_.forgetLast();
  stream(device);
}

void CameraWorker::stream(V4l2Device& device) {
  std::int64_t latest_ns = kernel_.monotonicNow();
  const auto stall_ns = static_cast<std::int64_t>(config_.stall_timeout_s * 1e9);
  while (sleepUnlessStopped(Backoff::Duration(0))) {
    const std::vector<ControlSetting> changed = wanted_controls_.takeNew();
    if (!changed.empty()) {
      applyControls(device, changed);
      next_exposure_reading_ns_ = 0;
      exposure_reader_.forgetLast();
    }
    allocate(format_.layout, config_.encoding, prepared_);
    if (!device.wait(kPoll_ms)) {
      if (kernel_.monotonicNow() - latest_ns < stall_ns) continue;
      update([](CameraStatus& status) { ++status.stalls; });
      throw CaptureError(
          Step::kWait, 0,
          device.path() + ": no image for " + std::to_string(config_.stall_timeout_s) +
              " s: the camera stopped sending, as cheap ones do on a weak hub or a long cable; it is opened "
              "again");
    }
    latest_ns = kernel_.monotonicNow();
    const auto newest = takeNewest(device);
    if (newest) deliver(device, *newest);
    if (latest_ns >= next_exposure_reading_ns_) {
      next_exposure_reading_ns_ = latest_ns + kExposureInterval_ns;
      readExposure(device);
    }
  }
}

std::optional<LentBuffer> CameraWorker::takeNewest(V4l2Device& device) {
  std::optional<LentBuffer> newest;
  while (auto buffer = device.dequeue()) {
    sequence_.add(buffer->sequence);
    rate_.add(buffer->dequeued_ns);
    const bool broken = buffer->isBroken();
    const bool overtakes = !broken && newest;
    if (!broken) std::swap(buffer, newest);
    if (buffer) device.giveBack(*buffer);
    update([&](CameraStatus& status) {
      status.lost = sequence_.lost();
      status.flagged_broken += broken ? 1 : 0;
      status.skipped += overtakes ? 1 : 0;
      status.rate_hz = rate_.rate_hz(kernel_.monotonicNow());
    });
  }
  return newest;
}

void CameraWorker::deliver(V4l2Device& device, const LentBuffer& buffer) {
  const std::int64_t start_ns = kernel_.monotonicNow();
  const std::string problem = decode(buffer.data, buffer.size, format_.layout, config_.encoding, prepared_);
  const std::int64_t decoding_ns = kernel_.monotonicNow() - start_ns;
  device.giveBack(buffer);
  if (!problem.empty()) {
    noteUndecodable(problem, buffer.dequeued_ns);
    return;
  }
  Frame frame;
  frame.image = std::exchange(prepared_, {});
  frame.dequeued_ns = buffer.dequeued_ns;
  frame.decoding_ns = decoding_ns;
  frame.stamp_ns = clock_.monotonicStamp(buffer);
  frame.time_ns = middleOfExposure(frame.stamp_ns, buffer.flags, exposure_s_, config_.rolling_shutter_s);
  frame.sequence = buffer.sequence;
  frame.lost = sequence_.lost();
  if (exposure_s_) frame.exposure_s = *exposure_s_;
  if (!frames_flow_) noteFirstFrame();
  update([&](CameraStatus& status) {
    ++status.frames;
    status.decode_time_s = 1e-9 * static_cast<double>(decoding_ns);
  });
  on_frame_(std::move(frame));
}

void CameraWorker::setControl(const std::string& name, std::int32_t value) {
  wanted_controls_.set(name, value);
}

void CameraWorker::applyControls(V4l2Device& device, const std::vector<ControlSetting>& settings) {
  const std::vector<std::string> warnings = device.controls().apply(settings);
  for (const auto& warning : warnings) log_(Severity::kWarning, config_.name + " camera: " + warning);
  update([&](CameraStatus& status) {
    status.control_warnings.insert(status.control_warnings.end(), warnings.begin(), warnings.end());
  });
}

void CameraWorker::readExposure(V4l2Device& device) {
  const ExposureReading reading = exposure_reader_.read(device.controls());
  exposure_s_ = reading.exposure_s();
  update([&](CameraStatus& status) {
    status.exposure = reading.exposure;
    status.gain = reading.gain;
    status.exposure_unknown = reading.untold;
  });
}

void CameraWorker::noteUndecodable(const std::string& problem, std::int64_t now_ns) {
  update([](CameraStatus& status) { ++status.undecodable; });
  if (now_ns < next_undecodable_log_ns_) return;
  next_undecodable_log_ns_ = now_ns + kLogInterval_ns;
  log_(Severity::kWarning, config_.name + " camera: image dropped: " + problem +
                               "; now and then this is normal for USB, often it means a bad cable or hub");
}

void CameraWorker::noteFailure(const CaptureError& error) {
  const std::string problem = error.what();
  if (problem != logged_problem_) {
    log_(Severity::kError, config_.name + " camera: " + problem + " (trying again)");
  }
  logged_problem_ = problem;
  update([&](CameraStatus& status) {
    status.state = CameraState::kRetrying;
    status.failed_attempts += frames_flow_ ? 0 : 1;
    status.problem = problem;
    status.rate_hz = 0.0;
  });
}

void CameraWorker::noteFirstFrame() {
  frames_flow_ = true;
  backoff_.reset();
  logged_problem_.clear();
  const bool again = starts_++ > 0;
  if (!clock_.warning().empty() && !again) {
    log_(Severity::kWarning, config_.name + " camera: " + clock_.warning());
  }
  update([&](CameraStatus& status) {
    status.state = CameraState::kStreaming;
    status.problem.clear();
    status.clock_warning = clock_.warning();
    status.reconnections += again ? 1 : 0;
  });
  log_(Severity::kInfo, config_.name + " camera: images from " + seen_before_->card + ", " +
                            seen_before_->path + (again ? " again" : ""));
  if (!again) warnOfAnotherRate();
  on_start_();
}

void CameraWorker::warnOfAnotherRate() {
  const double wanted_hz = config_.format.rate_hz;
  if (format_.rate_hz <= 0.0 || std::abs(format_.rate_hz - wanted_hz) < kRateTolerance * wanted_hz) return;
  std::ostringstream text;
  text << config_.name << " camera: runs at " << format_.rate_hz << " Hz instead of " << wanted_hz << ": in "
       << fourccText(fourccOf(format_.layout.format)) << " " << format_.layout.width << "x"
       << format_.layout.height << " it has no such rate; `rosrun stereo_nav list_cameras` shows which";
  log_(Severity::kWarning, text.str());
}

bool CameraWorker::sleepUnlessStopped(Backoff::Duration duration) {
  std::unique_lock<std::mutex> lock(mutex_);
  return !stop_requested_.wait_for(lock, duration, [this] { return stopping_; });
}

}  // namespace stereo_nav::camera
