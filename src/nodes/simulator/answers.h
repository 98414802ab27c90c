#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <topic_tools/shape_shifter.h>

#include <cstdint>
#include <deque>
#include <string>

namespace stereo_nav::nodes {

/// Waits for messages on topics of any type: those with which the consumers of a simulation say that they are
/// done. A topic that has not answered within the time limit is not waited for again until it is heard.
class Answers {
 public:
  /// `topics`: names separated by spaces, none or more. Callbacks go to `queue`.
  Answers(ros::NodeHandle handle, ros::CallbackQueue& queue, const std::string& topics, double limit_s);

  /// Waits until each topic has a publisher, at most `limit_s`.
  void awaitPublishers(double limit_s);
  /// From now on `count` more messages are due on each topic.
  void expect(std::uint64_t count);
  /// Serves the queue until they have come, or the time limit has passed: then says so.
  void await();
  /// How often a topic did not answer in time.
  std::uint64_t missed() const { return missed_; }

 private:
  struct Topic {
    std::string name;
    ros::Subscriber subscriber;
    std::uint64_t received = 0, due = 0;
    bool is_awaited = true;
  };

  /// Serves the queue until the condition holds, at most `limit_s`; returns whether it holds.
  template <class Condition>
  bool serveUntil(const Condition& holds, double limit_s);

  ros::CallbackQueue& queue_;
  double limit_s_;
  std::deque<Topic> topics_;
  std::uint64_t missed_ = 0;
};

}  // namespace stereo_nav::nodes
