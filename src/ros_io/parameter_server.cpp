#include "stereo_nav/ros_io/parameter_server.h"

namespace stereo_nav::ros_io {

YAML::Node toYaml(const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue readable = value;  // XmlRpcValue's conversions are not const
  YAML::Node node;
  switch (readable.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      node = static_cast<bool>(readable);
      break;
    case XmlRpc::XmlRpcValue::TypeInt:
      node = static_cast<int>(readable);
      break;
    case XmlRpc::XmlRpcValue::TypeDouble:
      node = static_cast<double>(readable);
      break;
    case XmlRpc::XmlRpcValue::TypeString:
      node = static_cast<std::string>(readable);
      break;
    case XmlRpc::XmlRpcValue::TypeArray:
      node = YAML::Node(YAML::NodeType::Sequence);
      for (int i = 0; i < readable.size(); ++i) node.push_back(toYaml(readable[i]));
      break;
    case XmlRpc::XmlRpcValue::TypeStruct:
      node = YAML::Node(YAML::NodeType::Map);
      for (auto& entry : readable) node[entry.first] = toYaml(entry.second);
      break;
    default:
      break;
  }
  return node;
}

YAML::Node parameterTree(const ros::NodeHandle& handle, const std::set<std::string>& except) {
  XmlRpc::XmlRpcValue value;
  if (!handle.getParam(handle.getNamespace(), value)) return YAML::Node(YAML::NodeType::Map);
  YAML::Node tree = toYaml(value);
  for (const auto& name : except) tree.remove(name);
  return tree;
}

}  // namespace stereo_nav::ros_io
