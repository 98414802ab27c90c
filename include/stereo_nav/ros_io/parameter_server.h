#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

#include <set>
#include <string>

#include "stereo_nav/params/parameters.h"

namespace stereo_nav::ros_io {

/// Structs, arrays and scalars of the parameter server as YAML, numbers without loss. Binary values and dates
/// become empty nodes, which readParameters() refuses where it expects a value.
YAML::Node toYaml(const XmlRpc::XmlRpcValue& value);

/// Everything below the handle's namespace, without the top-level names in `except`; an empty map if there is
/// nothing.
YAML::Node parameterTree(const ros::NodeHandle& handle, const std::set<std::string>& except = {});

/// Fills `params` from the handle's namespace by the one mechanism for all parameters. Names in `except`
/// belong to others (libraries that share a private namespace). Throws ParameterError.
template <class Params>
void readParameters(const ros::NodeHandle& handle, const std::set<std::string>& except, Params& params) {
  stereo_nav::readParameters(parameterTree(handle, except), handle.getNamespace(), params);
}

}  // namespace stereo_nav::ros_io
