#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::ros_io {

/// Converts structs, arrays and scalars of the parameter server to YAML, numbers without loss. Binary values
/// and dates become empty nodes, which readParameters() refuses where it expects a value.
YAML::Node toYaml(const XmlRpc::XmlRpcValue& value);

/// Reads everything below the handle's namespace, without the top-level names in `except`; an empty map if
/// there is nothing.
YAML::Node parameterTree(const ros::NodeHandle& handle, const std::set<std::string>& except = {});

namespace internal {
void writeParameters(const ros::NodeHandle& handle, const std::function<void(ParameterVisitor&)>& describe);
}

/// Writes every field below the handle's namespace, for `rosparam get` and for libraries that read their
/// values there, such as dynamic_reconfigure.
template <class Params>
void writeParameters(const ros::NodeHandle& handle, const Params& params) {
  Params copy = params;
  internal::writeParameters(handle, [&copy](ParameterVisitor& visitor) { copy.describe(visitor); });
}

/// A source of values, with the name that messages give it.
struct ParameterSource {
  YAML::Node tree;  ///< a map, or empty
  std::string name;
};

/// Parameters reach a node as files whose paths its launch file gives as arguments (`_config:=PATH`,
/// `_rig:=PATH`), and through the parameter server. A path among the arguments survives the loss of the
/// master: a node that is started again afterwards reads the same values, whereas those that roslaunch loaded
/// onto the parameter server are lost.
///
/// Reads the file whose path is parameter `name`; empty where that is not set. Throws ParameterError.
ParameterSource fileSource(const ros::NodeHandle& private_handle, const std::string& name);
/// Reads a section of the rig file whose path is `~rig`; empty where that is not set. Throws ParameterError.
ParameterSource rigSource(const ros::NodeHandle& private_handle, const std::string& section);
/// Reads the parameters below the handle's namespace, without the names in `except`, which belong to
/// libraries that share the private namespace, and without `config`, `rig` and `if_in_rig`, which say where
/// to read.
ParameterSource serverSource(const ros::NodeHandle& handle, const std::set<std::string>& except = {});

/// Fills `params` from all sources, by the same mechanism as all parameters; later sources overlay earlier
/// ones. Throws ParameterError.
template <class Params>
void readParameters(const std::vector<ParameterSource>& sources, Params& params) {
  for (const auto& source : sources) stereo_nav::readParameters(source.tree, source.name, params);
}

}  // namespace stereo_nav::ros_io
