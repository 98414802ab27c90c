#include "stereo_nav/ros/recorded_order.h"

#include <rosbag/view.h>

#include <algorithm>
#include <memory>
#include <tuple>

#include "stereo_nav/ros/recorded_clock.h"

namespace stereo_nav::ros_io {
namespace {

/// A message as the bag's index knows it.
struct IndexedMessage {
  const rosbag::ConnectionInfo* connection;
  const rosbag::IndexEntry* entry;
  ros::Time received;
};

/// Gives access to the index, which rosbag keeps to itself and to views.
class IndexView : public rosbag::View {
 public:
  IndexView(const rosbag::Bag& bag, const std::vector<std::string>& topics)
      : rosbag::View(bag, rosbag::TopicQuery(topics)), bag_(bag) {}

  /// Of each connection, in the order of the file.
  std::vector<std::vector<IndexedMessage>> connections() const {
    std::vector<std::vector<IndexedMessage>> connections;
    for (const rosbag::MessageRange* range : ranges_) {
      std::vector<IndexedMessage> messages;
      for (auto entry = range->begin; entry != range->end; ++entry)
        messages.push_back({range->connection_info, &*entry, entry->time});
      std::sort(messages.begin(), messages.end(), [](const IndexedMessage& a, const IndexedMessage& b) {
        return std::tie(a.entry->chunk_pos, a.entry->offset) < std::tie(b.entry->chunk_pos, b.entry->offset);
      });
      connections.push_back(std::move(messages));
    }
    return connections;
  }

  std::unique_ptr<rosbag::MessageInstance> message(const IndexedMessage& indexed) {
    return std::unique_ptr<rosbag::MessageInstance>(
        newMessageInstance(indexed.connection, *indexed.entry, bag_));
  }

 private:
  const rosbag::Bag& bag_;
};

std::vector<ros::Time> timesOf(const std::vector<IndexedMessage>& messages) {
  std::vector<ros::Time> times;
  for (const IndexedMessage& message : messages) times.push_back(message.received);
  return times;
}

ros::Duration medianInterval(const std::vector<ros::Time>& times) {
  std::vector<ros::Duration> intervals;
  for (std::size_t i = 1; i < times.size(); ++i) intervals.push_back(times[i] - times[i - 1]);
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

}  // namespace

RecordedOrder::RecordedOrder(const rosbag::Bag& bag, const std::string& clock_topic) {
  const auto connections = IndexView(bag, {clock_topic}).connections();
  if (connections.size() != 1) return;
  const std::vector<ros::Time> times = timesOf(connections.front());
  ros::Duration offset(0.0);
  std::size_t begin = 0;
  for (const std::size_t jump : clockJumps(times)) {
    if (times[jump] < times[begin]) {
      offsets_.clear();
      return;
    }
    offset += times[jump - 1] - times[jump] + medianInterval(times);
    offsets_.push_back(offset);
    begin = jump;
  }
}

void RecordedOrder::forEach(const rosbag::Bag& bag, const std::vector<std::string>& topics,
                            const Handle& handle) const {
  if (offsets_.empty()) {
    rosbag::View view(bag, rosbag::TopicQuery(topics));
    for (const rosbag::MessageInstance& message : view) handle(message, message.getTime());
    return;
  }
  IndexView view(bag, topics);
  std::vector<IndexedMessage> all;
  for (std::vector<IndexedMessage>& messages : view.connections()) {
    std::vector<std::size_t> jumps = clockJumps(timesOf(messages));
    jumps.resize(std::min(jumps.size(), offsets_.size()));
    for (std::size_t k = 0; k < jumps.size(); ++k) {
      const std::size_t end = k + 1 < jumps.size() ? jumps[k + 1] : messages.size();
      for (std::size_t i = jumps[k]; i < end; ++i) messages[i].received += offsets_[k];
    }
    all.insert(all.end(), messages.begin(), messages.end());
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const IndexedMessage& a, const IndexedMessage& b) { return a.received < b.received; });
  for (const IndexedMessage& indexed : all) handle(*view.message(indexed), indexed.received);
}

}  // namespace stereo_nav::ros_io
