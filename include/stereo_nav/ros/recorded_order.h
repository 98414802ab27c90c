#pragma once

#include <ros/time.h>
#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace stereo_nav::ros_io {

/// The messages of a bag in the order of recording. rosbag hands messages out by their times of receipt.
/// Where the recorder's own clock was set back, that mixes what was recorded before with what was recorded
/// after; the places in the file still tell them apart.
class RecordedOrder {
 public:
  RecordedOrder() = default;
  /// `clock_topic` holds messages at regular intervals: the first one after the clock was set back is taken
  /// as received one interval, the median of all, after the last one before. Parts whose times do not
  /// overlap, such as those of bags that were merged, keep their times.
  RecordedOrder(const rosbag::Bag& bag, const std::string& clock_topic);

  /// How often the clock was set back into times already recorded.
  std::size_t setBacks() const { return offsets_.size(); }

  /// `received` is the time of receipt as if the clock had not been set back.
  using Handle = std::function<void(const rosbag::MessageInstance& message, const ros::Time& received)>;
  /// Hands out the messages of these topics in the order of recording; `bag` is that of the constructor.
  void forEach(const rosbag::Bag& bag, const std::vector<std::string>& topics, const Handle& handle) const;

 private:
  std::vector<ros::Duration> offsets_;  ///< one a set-back, from it on
};

}  // namespace stereo_nav::ros_io
