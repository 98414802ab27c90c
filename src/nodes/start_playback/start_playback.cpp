// Waits until every subscriber of the graph is connected, then starts a paused `rosbag play`. A subscriber
// that connects later misses earlier messages; a chain of nodelets would miss the first few frames.
#include <std_srvs/SetBool.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ros/node_program.h"
#include "ros/slave_api.h"

namespace {

using Connection = std::pair<std::string, std::string>;  // topic, subscribing node
using NodesByTopic = std::map<std::string, std::vector<std::string>>;

constexpr double kPoll_s = 0.1;
/// The graph must be unchanged in this many observations: lazy nodelets subscribe one after the other.
constexpr int kSteadyPolls = 5;

NodesByTopic readNodes(XmlRpc::XmlRpcValue& list) {
  NodesByTopic nodes;
  for (int i = 0; i < list.size(); ++i) {
    auto& of_topic = nodes[static_cast<std::string>(list[i][0])];
    for (int j = 0; j < list[i][1].size(); ++j) of_topic.push_back(static_cast<std::string>(list[i][1][j]));
  }
  return nodes;
}

/// The established connections of a publisher, as it reports them itself.
std::set<Connection> connectionsOf(const std::string& node) {
  std::set<Connection> connections;
  XmlRpc::XmlRpcValue bus;
  if (!stereo_nav::ros_io::askNode(node, "getBusInfo", bus)) return connections;
  for (int i = 0; i < bus.size(); ++i) {
    auto& entry = bus[i];  // id, other end, direction, transport, topic, ...
    if (static_cast<std::string>(entry[2]) != "o") continue;
    connections.emplace(static_cast<std::string>(entry[4]), static_cast<std::string>(entry[1]));
  }
  return connections;
}

struct Graph {
  std::set<Connection> established;
  std::set<std::string> missing;  ///< connections that are still missing, in words
};

/// Topics that must be connected before playback.
struct Wanted {
  std::vector<std::string> topics;         ///< with a publisher and a subscriber
  std::vector<std::string> published;      ///< with a publisher
  std::vector<std::string> if_subscribed;  ///< with a publisher, if anybody subscribes
};

Graph lookAt(const Wanted& wanted) {
  Graph graph;
  XmlRpc::XmlRpcValue arguments, result, payload;
  arguments[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", arguments, result, payload, true)) return graph;
  NodesByTopic publishers = readNodes(payload[0]);
  NodesByTopic subscribers = readNodes(payload[1]);
  for (const auto& topic : wanted.topics) {
    if (publishers[topic].empty()) graph.missing.insert("a publisher of " + topic);
    if (subscribers[topic].empty()) graph.missing.insert("a subscriber of " + topic);
  }
  for (const auto& topic : wanted.published) {
    if (publishers[topic].empty()) graph.missing.insert("a publisher of " + topic);
  }
  for (const auto& topic : wanted.if_subscribed) {
    if (!subscribers[topic].empty() && publishers[topic].empty())
      graph.missing.insert("a publisher of " + topic);
  }
  std::map<std::string, std::set<Connection>> of_node;
  for (const auto& [topic, nodes] : publishers) {
    for (const auto& node : nodes) {
      if (of_node.count(node) == 0) of_node[node] = connectionsOf(node);
      for (const auto& subscriber : subscribers[topic]) {
        if (of_node[node].count({topic, subscriber}) > 0) {
          graph.established.emplace(topic, subscriber);
        } else if (!of_node[node].empty()) {
          graph.missing.insert(node + " -> " + subscriber + " on " + topic);
        }
      }
    }
  }
  return graph;
}

/// Returns the connections that were still missing when the time was over; empty if all are connected.
std::set<std::string> waitForGraph(const Wanted& wanted, double timeout_s) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(timeout_s);
  Graph before;
  int steady = 0;
  while (ros::ok()) {
    const Graph now = lookAt(wanted);
    steady = now.missing.empty() && now.established == before.established ? steady + 1 : 0;
    if (steady >= kSteadyPolls) return {};
    if (ros::WallTime::now() > end) return now.missing;
    before = now;
    ros::WallDuration(kPoll_s).sleep();
  }
  return {};
}

std::vector<std::string> topicsOf(const char* parameter) {
  std::vector<std::string> topics;
  ros::NodeHandle("~").getParam(parameter, topics);
  for (auto& topic : topics) topic = ros::names::resolve(topic);
  return topics;
}

int run() {
  ros::NodeHandle handle;
  ros::NodeHandle private_handle("~");
  const Wanted wanted{topicsOf("topics"), topicsOf("published"), topicsOf("if_subscribed")};
  const double timeout_s = private_handle.param("timeout_s", 30.0);
  const auto player = private_handle.param<std::string>("player", "player");

  auto pause = handle.serviceClient<std_srvs::SetBool>(player + "/pause_playback");
  while (ros::ok() && !pause.exists()) ros::WallDuration(kPoll_s).sleep();  // the ROS clock does not run yet
  const std::set<std::string> missing = waitForGraph(wanted, timeout_s);
  if (!ros::ok()) return 0;
  for (const auto& connection : missing) {
    ROS_WARN("playback starts without %s after %.0f s; did that node fail? First messages may be lost",
             connection.c_str(), timeout_s);
  }
  std_srvs::SetBool request;
  request.request.data = static_cast<std::uint8_t>(false);
  if (!pause.call(request)) {
    ROS_ERROR("%s cannot be started by its service: it must be `rosbag play --pause`", player.c_str());
    return 1;
  }
  ROS_INFO("all connected, playback starts");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "start_playback", run);
}
