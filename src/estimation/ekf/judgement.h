#pragma once

#include <array>
#include <string>
#include <vector>

#include "estimation/ekf/channel.h"

namespace stereo_nav::estimation {

/// Gate by the normalised innovation squared, and the noise that is learned from it: a channel whose
/// innovations are larger than its variances explain has its variances multiplied until they do, never below
/// what it states.
class Gate {
 public:
  explicit Gate(double share);

  /// Whether a measurement of so many fields passes; changes the channel's noise_factor.
  bool pass(const Channel& channel, int fields, double nis, ChannelMemory& memory) const;

 private:
  std::array<double, 7> limit_{};  ///< by number of fields
};

/// Two channels that contradict each other about one field.
struct Contradiction {
  int one = 0, other = 0;
  int field = 0;
  double difference = 0.0;  ///< m/s or rad/s
  double sigmas = 0.0;      ///< the same against what their variances explain
};

/// The outcome of a vote: who disagrees with whom.
struct Verdict {
  double from_s = 0.0;  ///< begin of the window
  std::vector<Contradiction> contradictions;
  int culprit = -1;   ///< that is outvoted; -1: nobody, or it cannot be told
  bool news = false;  ///< not in force yet
};

/// Compares all pairs of channels by their opinions of the last half second. A channel is outvoted where it
/// contradicts all others that speak about a field, and at least two of these agree.
Verdict vote(const std::vector<Channel>& channels, const std::vector<ChannelMemory>& memories);

/// Takes the verdict to heart, up to `until_s`: the culprit is set aside; of two that contradict each other
/// without a third one both are doubted, so that either may be right. Tells whether that is news.
bool heed(const Verdict& verdict, double now_s, double until_s, std::vector<ChannelMemory>& memories);

/// `odom0 (wheel/odom) and imu0 (imu/data) disagree about vyaw by 0.31 rad/s`.
std::string describe(const Contradiction& contradiction, const std::vector<Channel>& channels);

}  // namespace stereo_nav::estimation
