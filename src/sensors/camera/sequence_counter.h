#pragma once

#include <cstdint>
#include <optional>

namespace stereo_nav::camera {

/// Counts the frames that the driver lost: the gaps in its counter, which may wrap. A counter that stands
/// still or goes back (some drivers leave it at 0; a new stream starts at 0) is not taken as a loss.
class SequenceCounter {
 public:
  void restart() { latest_.reset(); }

  void add(std::uint32_t sequence) {
    if (latest_) {
      const std::uint32_t advance = sequence - *latest_;
      if (advance >= 1 && advance < 0x80000000u) lost_ += advance - 1;
    }
    latest_ = sequence;
  }

  std::uint64_t lost() const { return lost_; }

 private:
  std::optional<std::uint32_t> latest_;
  std::uint64_t lost_ = 0;
};

}  // namespace stereo_nav::camera
