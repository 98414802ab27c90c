#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sensors/laser/rplidar_protocol.h"

namespace stereo_nav::laser {

/// Brings a scanner from whatever it is doing to scanning: stop, information, health, scan. A reply that does
/// not come within half a second begins all of it again; a device that reports an error is reset first.
class RplidarSession {
 public:
  /// Sends a request to the device.
  using Write = std::function<void(rplidar::Command command)>;

  explicit RplidarSession(Write write) : write_(std::move(write)) {}

  /// Begins: the port was opened, or the scan has broken off.
  void begin(double now_s);
  /// Takes what was read, which may be nothing, and says how many of these bytes belong to replies: those
  /// behind are the nodes of the scan.
  std::size_t update(const std::uint8_t* data, std::size_t size, double now_s);

  bool scanning() const { return phase_ == Phase::kScanning; }
  double scanningSince_s() const { return phase_start_s_; }
  const std::optional<DeviceInfo>& info() const { return info_; }
  const std::optional<DeviceHealth>& health() const { return health_; }
  /// What keeps the device from scanning, likely cause and remedy; empty when nothing does.
  const std::string& problem() const { return problem_; }

 private:
  enum class Phase { kIdle, kStopping, kInfo, kHealth, kResetting, kStarting, kScanning };

  void enter(Phase phase, double now_s);
  std::optional<rplidar::Command> awaited() const;
  void passTime(double now_s);
  void takeReply(double now_s);
  void judgeHealth(double now_s);

  Write write_;
  Phase phase_ = Phase::kIdle;
  double phase_start_s_ = 0.0;
  std::vector<std::uint8_t> reply_;  ///< bytes since the request
  std::optional<DeviceInfo> info_;
  std::optional<DeviceHealth> health_;
  std::string problem_;
};

}  // namespace stereo_nav::laser
