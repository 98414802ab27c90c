#include "rostest/graph_probe.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::test {
namespace {

template <class Message>
ros::Subscriber collect(ros::NodeHandle& handle, const std::string& topic, std::vector<Message>& messages) {
  const boost::function<void(const boost::shared_ptr<const Message>&)> handler =
      [&messages](const boost::shared_ptr<const Message>& message) { messages.push_back(*message); };
  return handle.subscribe<Message>(topic, 1000, handler);
}

}  // namespace

GraphProbe::GraphProbe() {
  subscribers_.push_back(collect(handle_, "odom", odometry));
  subscribers_.push_back(collect(handle_, "vo/status", status));
  subscribers_.push_back(collect(handle_, "ground_truth/odom", ground_truth));
  const boost::function<void(const rosgraph_msgs::LogConstPtr&)> handler =
      [this](const rosgraph_msgs::LogConstPtr& message) { log.push_back(message->msg); };
  subscribers_.push_back(handle_.subscribe<rosgraph_msgs::Log>("/rosout", 1000, handler));
}

bool GraphProbe::waitForLog(const std::string& part, double timeout_s) {
  const auto isThere = [&] {
    return std::any_of(log.begin(), log.end(),
                       [&](const std::string& text) { return text.find(part) != std::string::npos; });
  };
  return spinUntil(isThere, timeout_s);
}

void GraphProbe::forget() {
  odometry.clear();
  status.clear();
  log.clear();
}

double distance(const nav_msgs::Odometry& a, const nav_msgs::Odometry& b) {
  const auto& p = a.pose.pose.position;
  const auto& q = b.pose.pose.position;
  return std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
}

}  // namespace stereo_nav::test
