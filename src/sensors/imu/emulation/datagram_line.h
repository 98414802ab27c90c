#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "sensors/imu/udp_source.h"

namespace stereo_nav::imu {

struct DatagramOptions {
  UdpAddress target;
  double drop_probability = 0.0;      ///< that a datagram is lost
  double overtake_probability = 0.0;  ///< that a datagram arrives behind its successor
  double double_probability = 0.0;    ///< that a datagram arrives twice
  double corrupt_probability = 0.0;   ///< that a byte is changed
  unsigned seed = 1;
};

/// Sends each frame as a datagram, over a network that loses, doubles, swaps and damages them.
class DatagramLine {
 public:
  /// Throws std::runtime_error.
  explicit DatagramLine(const DatagramOptions& options);
  ~DatagramLine();
  DatagramLine(const DatagramLine&) = delete;
  DatagramLine& operator=(const DatagramLine&) = delete;

  void send(const std::vector<std::uint8_t>& frame);

 private:
  void pass(const std::vector<std::uint8_t>& datagram);
  bool happens(double probability) { return std::uniform_real_distribution<double>()(random_) < probability; }

  DatagramOptions options_;
  std::mt19937 random_;
  std::vector<std::uint8_t> overtaken_;  ///< waits for its successor; empty: none does
  int fd_ = -1;
};

}  // namespace stereo_nav::imu
