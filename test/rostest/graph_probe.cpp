#include "rostest/graph_probe.h"

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

bool GraphProbe::waitUntil(const std::function<bool()>& condition, double timeout_s) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(timeout_s);
  while (ros::ok() && !condition()) {
    if (ros::WallTime::now() > end) return false;
    ros::spinOnce();
    ros::WallDuration(0.005).sleep();
  }
  return ros::ok();
}

bool GraphProbe::waitForLog(const std::string& part, double timeout_s) {
  return waitUntil(
      [&] {
        for (const auto& text : log) {
          if (text.find(part) != std::string::npos) return true;
        }
        return false;
      },
      timeout_s);
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
