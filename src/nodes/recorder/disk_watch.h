#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

namespace stereo_nav::nodes {

/// How fast a recording grows and how long the disk lasts. Knows no files and no clock.
class DiskWatch {
 public:
  /// `reserve_bytes`: space that the recorder leaves free. `warn_before_s`: the disk is low when it will be
  /// full in less than this time.
  DiskWatch(std::uint64_t reserve_bytes, double warn_before_s)
      : reserve_bytes_(reserve_bytes), warn_before_s_(warn_before_s) {}

  void add(double time_s, std::uint64_t bytes_written, std::uint64_t bytes_free);

  enum class State { kStarting, kGood, kSilent, kLow, kFull };
  State state() const;
  /// Bytes per second over the last ten seconds; 0 before there are two samples.
  double rate() const;
  /// Seconds until only the reserve is left; no value while nothing is written.
  std::optional<double> secondsLeft() const;
  std::uint64_t bytesWritten() const { return samples_.empty() ? 0 : samples_.back().written; }
  std::uint64_t bytesFree() const { return samples_.empty() ? 0 : samples_.back().free; }
  /// The state in words, with the remedy where something is wrong.
  std::string text() const;

 private:
  struct Sample {
    double time_s;
    std::uint64_t written, free;
  };

  std::uint64_t reserve_bytes_;
  double warn_before_s_;
  std::deque<Sample> samples_;
};

}  // namespace stereo_nav::nodes
