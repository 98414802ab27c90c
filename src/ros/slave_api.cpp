#include "ros/slave_api.h"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcClient.h>

namespace stereo_nav::ros_io {

bool askNode(const std::string& node, const std::string& method, XmlRpc::XmlRpcValue& answer) {
  XmlRpc::XmlRpcValue arguments, reply, uri;
  arguments[0] = ros::this_node::getName();
  arguments[1] = node;
  if (!ros::master::execute("lookupNode", arguments, reply, uri, false)) return false;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(static_cast<std::string>(uri), host, port)) return false;

  XmlRpc::XmlRpcValue caller, result;  // result: status code, message, answer
  caller[0] = ros::this_node::getName();
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  if (!client.execute(method.c_str(), caller, result)) return false;
  if (result.getType() != XmlRpc::XmlRpcValue::TypeArray || result.size() < 3) return false;
  answer = result[2];
  return static_cast<int>(result[0]) == 1;
}

}  // namespace stereo_nav::ros_io
