#pragma once

#include <chrono>
#include <thread>

namespace stereo_nav::test {

/// For a loaded machine; nothing waits this long otherwise.
constexpr double kLongWait_s = 90.0;

/// Asks every `poll_s` seconds whether `condition` holds; false when it still does not after `timeout_s`.
/// It is asked at least once. With a poll of 0 the condition itself has to take its time.
template <class Condition>
bool waitUntil(Condition&& condition, double timeout_s = kLongWait_s, double poll_s = 0.005) {
  using Seconds = std::chrono::duration<double>;
  const auto end = std::chrono::steady_clock::now() + Seconds(timeout_s);
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    if (poll_s > 0.0) std::this_thread::sleep_for(Seconds(poll_s));
  }
  return true;
}

}  // namespace stereo_nav::test
