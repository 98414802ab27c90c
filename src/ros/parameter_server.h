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

/// Structs, arrays and scalars of the parameter server as YAML, numbers without loss. Binary values and dates
/// become empty nodes, which readParameters() refuses where it expects a value.
YAML::Node toYaml(const XmlRpc::XmlRpcValue& value);

/// Everything below the handle's namespace, without the top-level names in `except`; an empty map if there is
/// nothing.
YAML::Node parameterTree(const ros::NodeHandle& handle, const std::set<std::string>& except = {});

namespace internal {
void writeParameters(const ros::NodeHandle& handle, const std::function<void(ParameterVisitor&)>& describe);
}

/// Writes every field below the handle's namespace: for libraries that take their values from there,
/// dynamic_reconfigure among them, and for `rosparam get`.
template <class Params>
void writeParameters(const ros::NodeHandle& handle, const Params& params) {
  Params copy = params;
  internal::writeParameters(handle, [&copy](ParameterVisitor& visitor) { copy.describe(visitor); });
}

/// Where values come from, with the name that messages give it.
struct ParameterSource {
  YAML::Node tree;  ///< a map, or empty
  std::string name;
};

/// Parameters reach a node as files whose paths its launch file gives as arguments (`_config:=PATH`,
/// `_rig:=PATH`), and through the parameter server. A path among the arguments survives the master: a node
/// that is started again after the master has gone reads the same values, where those that roslaunch had
/// loaded are lost.
///
/// The file whose path is parameter `name`; empty where that is not set. Throws ParameterError.
ParameterSource fileSource(const ros::NodeHandle& private_handle, const std::string& name);
/// A section of the rig file whose path is `~rig`; empty where that is not set. Throws ParameterError.
ParameterSource rigSource(const ros::NodeHandle& private_handle, const std::string& section);
/// What is below the handle's namespace without the names in `except`, which belong to others (libraries that
/// share a private namespace), and without those of the paths, `config` and `rig`.
ParameterSource serverSource(const ros::NodeHandle& handle, const std::set<std::string>& except = {});

/// Fills `params` from all sources by the one mechanism for all parameters; later ones overlay earlier ones.
/// Throws ParameterError.
template <class Params>
void readParameters(const std::vector<ParameterSource>& sources, Params& params) {
  for (const auto& source : sources) stereo_nav::readParameters(source.tree, source.name, params);
}

}  // namespace stereo_nav::ros_io
