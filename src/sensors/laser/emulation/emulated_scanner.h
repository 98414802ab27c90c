#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "sensors/laser/rplidar_protocol.h"

namespace stereo_nav::laser {

struct ScannerOptions {
  double sample_rate_hz = 2000.0;
  double scan_rate_hz = 5.5;
  double room_length_m = 6.0;  ///< along the scanner's x axis; it stands in the middle
  double room_width_m = 4.0;
  double noise_m = 0.0;        ///< standard deviation of a distance
  double missing_share = 0.0;  ///< share of samples without a valid distance
  std::uint16_t error_code =
      0;  ///< other than 0: the scanner reports it and does not scan until it was reset
  unsigned seed = 1;
};

/// An RPLiDAR A1 in the middle of a rectangular room. It obeys requests and sends its samples while it scans;
/// its head turns evenly from time 0 on, with heading 0 at time 0. Deterministic for a seed.
class EmulatedScanner {
 public:
  /// What is to be sent, and when it begins to be sent.
  struct Output {
    double time_s;
    std::vector<std::uint8_t> bytes;
  };

  explicit EmulatedScanner(const ScannerOptions& options) : options_(options), random_(options.seed) {}

  /// Takes what the host has sent; returns the replies.
  std::vector<Output> receive(const std::vector<std::uint8_t>& bytes, double time_s);
  /// Returns the nodes measured since the last call, up to `time_s`.
  std::vector<Output> advance(double time_s);

  bool scanning() const { return scanning_; }
  double heading_deg(double time_s) const;
  /// The distance to the walls, without noise.
  double distance_m(double heading_deg) const;

 private:
  std::vector<std::uint8_t> obey(rplidar::Command command, double time_s);
  ScanNode measure(double time_s);

  ScannerOptions options_;
  std::mt19937 random_;
  bool sync_seen_ = false;  ///< the last byte of the host began a request
  bool scanning_ = false;
  std::uint64_t next_sample_ = 0;
  double last_heading_deg_ = 360.0;
};

}  // namespace stereo_nav::laser
