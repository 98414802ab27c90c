#include "ros/parameter_server.h"

#include "core/rig_file.h"

namespace stereo_nav::ros_io {
namespace {

/// Sections become namespaces.
class ServerWriter : public ParameterVisitor {
 public:
  explicit ServerWriter(const ros::NodeHandle& handle) : handles_{handle} {}

  void enterSection(const std::string& name) override { handles_.emplace_back(handles_.back(), name); }
  void leaveSection() override { handles_.pop_back(); }

 private:
  void visit(const ParameterField& field, bool& value) override { set(field.name, value); }
  void visit(const ParameterField& field, int& value, Range<int>) override { set(field.name, value); }
  void visit(const ParameterField& field, double& value, Range<double>) override { set(field.name, value); }
  void visit(const ParameterField& field, std::string& value) override { set(field.name, value); }
  void visit(const ParameterField& field, std::size_t& index,
             const std::vector<std::string>& names) override {
    set(field.name, names[index]);
  }

  template <class T>
  void set(const std::string& name, const T& value) {
    handles_.back().setParam(name, value);
  }

  std::vector<ros::NodeHandle> handles_;
};

const std::string kRigPath = "rig";

std::string pathIn(const ros::NodeHandle& private_handle, const std::string& name) {
  return private_handle.param<std::string>(name, "");
}

}  // namespace

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

namespace internal {

void writeParameters(const ros::NodeHandle& handle, const std::function<void(ParameterVisitor&)>& describe) {
  ServerWriter writer(handle);
  describe(writer);
}

}  // namespace internal

ParameterSource fileSource(const ros::NodeHandle& private_handle, const std::string& name) {
  const std::string path = pathIn(private_handle, name);
  if (path.empty()) return {};
  return {loadYamlFile(path), path};
}

ParameterSource rigSource(const ros::NodeHandle& private_handle, const std::string& section) {
  const std::string path = pathIn(private_handle, kRigPath);
  if (path.empty()) return {};
  const RigFile rig = RigFile::load(path);
  return {rig.section(section), rig.sectionName(section)};
}

ParameterSource serverSource(const ros::NodeHandle& handle, const std::set<std::string>& except) {
  std::set<std::string> others = except;
  others.insert({"config", kRigPath, "if_in_rig"});
  return {parameterTree(handle, others), handle.getNamespace()};
}

}  // namespace stereo_nav::ros_io
