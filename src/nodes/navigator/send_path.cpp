// Sends a path from a file to the navigator, once, and ends.
#include "navigation/planner/path_file.h"
#include "nodes/navigator/navigator_messages.h"
#include "nodes/navigator/send_path_params.h"
#include "ros/node_program.h"
#include "ros/parameter_server.h"

namespace {

constexpr double kPoll_s = 0.05;
constexpr double kRemind_s = 5.0;
constexpr double kLinger_s = 0.5;  // the message is sent by another thread

int run() {
  stereo_nav::nodes::SendPathParams params;
  stereo_nav::ros_io::readParameters({stereo_nav::ros_io::serverSource(ros::NodeHandle("~"))}, params);
  const auto poses = stereo_nav::navigation::readPath(params.file);
  nav_msgs::Path path;
  path.header.frame_id = params.frame;
  path.header.stamp = ros::Time::now();
  for (const auto& pose : poses) {
    path.poses.emplace_back();
    path.poses.back().header = path.header;
    path.poses.back().pose = stereo_nav::nodes::toMessage(pose);
  }
  // Not latched: a navigator that is started again shall not drive by itself.
  ros::NodeHandle handle;
  const ros::Publisher publisher = handle.advertise<nav_msgs::Path>("navigator/path", 1);
  while (ros::ok() && publisher.getNumSubscribers() == 0) {
    ROS_WARN_STREAM_THROTTLE(kRemind_s,
                             "nobody listens to " << publisher.getTopic() << "; is the navigator running?");
    ros::WallDuration(kPoll_s).sleep();
  }
  publisher.publish(path);
  ros::WallDuration(kLinger_s).sleep();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "send_path", run);
}
