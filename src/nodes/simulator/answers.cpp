#include "nodes/simulator/answers.h"

#include <algorithm>
#include <sstream>

namespace stereo_nav::nodes {

Answers::Answers(ros::NodeHandle handle, ros::CallbackQueue& queue, const std::string& topics, double limit_s)
    : queue_(queue), limit_s_(limit_s) {
  std::istringstream names(topics);
  for (std::string name; names >> name;) {
    topics_.push_back({name, {}});
    Topic& topic = topics_.back();
    topic.subscriber = handle.subscribe<topic_tools::ShapeShifter>(
        name, 1000,
        [&topic](const topic_tools::ShapeShifter::ConstPtr&) {
          ++topic.received;
          topic.is_awaited = true;
        },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  }
}

template <class Condition>
bool Answers::serveUntil(const Condition& holds, double limit_s) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(limit_s);
  while (!holds()) {
    if (!ros::ok() || ros::WallTime::now() > end) return false;
    queue_.callAvailable(ros::WallDuration(1e-3));
  }
  return true;
}

void Answers::awaitPublishers(double limit_s) {
  for (const Topic& topic : topics_) {
    if (serveUntil([&] { return topic.subscriber.getNumPublishers() > 0; }, limit_s)) continue;
    ROS_WARN("nobody publishes %s, whose answers the simulator is to wait for: is its node started?",
             topic.name.c_str());
  }
}

void Answers::expect(std::uint64_t count) {
  for (Topic& topic : topics_)
    topic.due = topic.is_awaited ? std::max(topic.due, topic.received) + count : topic.received;
}

void Answers::await() {
  for (Topic& topic : topics_) {
    if (!topic.is_awaited || serveUntil([&] { return topic.received >= topic.due; }, limit_s_)) continue;
    if (!ros::ok()) return;
    topic.is_awaited = false;
    topic.due = topic.received;
    ++missed_;
    ROS_WARN(
        "no answer on %s within %.1f s: the simulation goes on without it until it is heard again. Its node is "
        "idle, has ended or is slow; then raise ~answer_limit_s.",
        topic.name.c_str(), limit_s_);
  }
}

}  // namespace stereo_nav::nodes
