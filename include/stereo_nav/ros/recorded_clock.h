#pragma once

#include <ros/time.h>

#include <cstddef>
#include <vector>

namespace stereo_nav::ros_io {

/// A stamp and when the recorder received its message.
struct ReceivedStamp {
  ros::Time stamp;     ///< of the header
  ros::Time received;  ///< when the recorder got the message
};

/// Places in a list of stamps in the order of recording from which on the clock runs behind: the stamp lies
/// more than a quarter of a second before the last one and before the one ahead of that, and the next two lie
/// before the last one, too. This tells a clock that was set back from a message that comes late or early.
/// Stamps of 0 are passed over.
std::vector<std::size_t> clockJumps(const std::vector<ros::Time>& stamps);

/// The clock of a recording whose host's clock was set back while it was recorded. Its stamps are put onto
/// one line of time: the later ones are moved by what the clock was set back by, which the times of receipt
/// tell.
class RecordedClock {
 public:
  RecordedClock() = default;
  /// From the images of one camera, in the order of recording.
  explicit RecordedClock(const std::vector<ReceivedStamp>& images);

  /// How often the clock was set back.
  std::size_t jumps() const { return offsets_.size(); }
  /// Stamps of one topic, in the order of recording, on the line of time.
  void straighten(std::vector<ros::Time>& stamps) const;
  /// The times of other items in that order, s.
  template <class Item, class TimeOf>
  void straighten(std::vector<Item>& items, const TimeOf& time_of) const {
    if (offsets_.empty()) return;
    std::vector<ros::Time> stamps;
    for (Item& item : items) stamps.emplace_back(time_of(item));
    straighten(stamps);
    for (std::size_t i = 0; i < items.size(); ++i) time_of(items[i]) = stamps[i].toSec();
  }
  /// What was added to a stamp that is `time_s` on the line of time.
  double offset_s(double time_s) const;

 private:
  std::vector<ros::Duration> offsets_;  ///< one a jump, from this jump on
  std::vector<double> begins_s_;        ///< of the stretches after the jumps, on the line of time
};

}  // namespace stereo_nav::ros_io
