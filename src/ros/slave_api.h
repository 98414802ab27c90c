#pragma once

#include <xmlrpcpp/XmlRpcValue.h>

#include <string>

namespace stereo_nav::ros_io {

/// Calls a method of another node's XML-RPC interface (ROS slave API, e.g. getBusInfo, getPid). Returns false
/// when the node is not registered, does not answer, or refuses.
bool askNode(const std::string& node, const std::string& method, XmlRpc::XmlRpcValue& answer);

}  // namespace stereo_nav::ros_io
