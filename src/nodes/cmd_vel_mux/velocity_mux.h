#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sensors/base/pause_guard.h"

namespace stereo_nav::nodes {

/// One of several senders of velocities.
struct VelocitySource {
  std::string topic;
  double timeout_s = 0.5;  ///< for how long a message keeps those of lower rank out
  bool stops = false;      ///< its messages stop the base, whatever they hold
};

/// Decides whose velocity passes: that of the first source in the list that was heard within its time-out.
/// Messages pass or do not; none is held back or repeated, so that the receiver's watchdog counts from the
/// sender's own last message.
class VelocityMux {
 public:
  /// In the order of their rank.
  explicit VelocityMux(std::vector<VelocitySource> sources);

  /// To be called all the time. Returns for how long the program stood still, 0 where it did not. After such
  /// a pause nobody has the word, and for a moment nothing passes but stops: what waited in the sockets is
  /// old.
  double tick(double now_s);
  /// A message of a source; returns whether it passes.
  bool offer(std::size_t source, double now_s);
  /// The source that has the word; nothing while all are silent.
  std::optional<std::size_t> active(double now_s) const;
  const std::vector<VelocitySource>& sources() const { return sources_; }
  /// Messages of a source that did not pass.
  std::size_t dropped(std::size_t source) const { return dropped_[source]; }
  std::size_t passed(std::size_t source) const { return passed_[source]; }

 private:
  base::PauseGuard guard_;
  std::vector<VelocitySource> sources_;
  std::vector<std::optional<double>> heard_s_;
  std::vector<std::size_t> dropped_, passed_;
};

}  // namespace stereo_nav::nodes
