#pragma once

#include <ros/time.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

namespace stereo_nav::ros_io {

/// A stamp this much older than the newest of its topic means that the clock jumped back (a bag that starts
/// again, or a corrected clock), not that the message is late.
constexpr double kClockJump_s = 0.5;

/// The last messages of one topic in order of their stamps. Their number is bounded; the oldest is dropped
/// and counted.
template <class MessagePtr>
class StampBuffer {
 public:
  struct Item {
    ros::Time stamp;
    MessagePtr message;
  };
  enum class Added {
    kKept,
    kStale,       ///< not newer than the newest message: ignored and counted
    kJumpedBack,  ///< kept; all earlier messages were dropped and counted
  };

  explicit StampBuffer(std::size_t capacity) : capacity_(capacity) {}

  Added add(const ros::Time& stamp, MessagePtr message) {
    Added result = Added::kKept;
    if (received_ > 0 && stamp <= newest_) {
      if ((newest_ - stamp).toSec() < kClockJump_s) {
        ++dropped_;
        return Added::kStale;
      }
      dropped_ += items_.size();
      items_.clear();
      result = Added::kJumpedBack;
    }
    ++received_;
    newest_ = stamp;
    items_.push_back({stamp, std::move(message)});
    if (items_.size() > capacity_) {
      items_.pop_front();
      ++dropped_;
    }
    return result;
  }

  /// The message with exactly this stamp; null if there is none.
  MessagePtr find(const ros::Time& stamp) const {
    for (const Item& item : items_) {
      if (item.stamp == stamp) return item.message;
    }
    return MessagePtr();
  }

  /// Drops the messages that are not newer than `stamp`; returns their number.
  std::size_t discardUpTo(const ros::Time& stamp) {
    std::size_t count = 0;
    for (; !items_.empty() && items_.front().stamp <= stamp; ++count) items_.pop_front();
    return count;
  }

  std::deque<Item>& items() { return items_; }
  const std::deque<Item>& items() const { return items_; }
  ros::Time newest() const { return newest_; }  ///< zero before the first message
  std::uint64_t received() const { return received_; }
  std::uint64_t dropped() const { return dropped_; }

 private:
  std::size_t capacity_;
  std::deque<Item> items_;
  ros::Time newest_;
  std::uint64_t received_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace stereo_nav::ros_io
