#include "sensors/serial/link.h"

#include <algorithm>
#include <chrono>
#include <thread>

#include "sensors/serial/steady_clock.h"

namespace stereo_nav::serial {

void LinkParams::describe(ParameterVisitor& visitor) {
  visitor.real("retry_s", retry_s, {0.05, 60.0}, "s", "time between attempts to open the port");
  visitor.real("reopen_silent_s", reopen_silent_s, {0.1, 3600.0}, "s",
               "a port that is silent for this long is opened anew, which some adapters need");
}

std::size_t Link::read(std::uint8_t* buffer, std::size_t capacity, double timeout_s) {
  double now_s = steadyNow_s();
  if (!source_ && now_s >= next_attempt_s_) tryOpen(now_s);
  if (!source_) {
    const double wait_s = std::min(timeout_s, std::max(0.0, next_attempt_s_ - now_s));
    std::this_thread::sleep_for(std::chrono::duration<double>(wait_s));
    return 0;
  }
  std::size_t size = 0;
  try {
    size = source_->read(buffer, capacity, timeout_s);
  } catch (const SerialError& error) {
    disconnect(error);
    return 0;
  }
  now_s = steadyNow_s();
  const std::lock_guard<std::mutex> lock(mutex_);
  monitor_.received(size, now_s);
  if (monitor_.silentFor_s(now_s) > params_.reopen_silent_s && now_s > next_attempt_s_) {
    source_.reset();
    next_attempt_s_ = now_s;
  }
  return size;
}

void Link::tryOpen(double now_s) {
  next_attempt_s_ = now_s + std::max(params_.retry_s, params_.reopen_silent_s);
  try {
    source_ = open_();
  } catch (const SerialError& error) {
    disconnect(error);
    return;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!monitor_.open()) ++connections_;
  monitor_.opened(now_s);
}

void Link::disconnect(const SerialError& error) {
  source_.reset();
  next_attempt_s_ = steadyNow_s() + params_.retry_s;
  const std::lock_guard<std::mutex> lock(mutex_);
  monitor_.closed();
  fault_ = error.what();
}

void Link::delivered() {
  const std::lock_guard<std::mutex> lock(mutex_);
  monitor_.delivered(steadyNow_s());
}

LinkStatus Link::status() const {
  const double now_s = steadyNow_s();
  const std::lock_guard<std::mutex> lock(mutex_);
  return {monitor_.state(now_s), monitor_.silentFor_s(now_s), fault_, connections_};
}

}  // namespace stereo_nav::serial
