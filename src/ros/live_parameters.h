#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::ros_io {

namespace internal {

using Describe = std::function<void(ParameterVisitor&)>;

/// The part of LiveParameters that does not depend on the struct.
class LiveParameterServer {
 public:
  /// `describe` visits the current values, `describe_defaults` those of an unchanged struct.
  LiveParameterServer(const ros::NodeHandle& handle, Describe describe, const Describe& describe_defaults,
                      std::function<void()> changed);

 private:
  /// Service and topics of one section that holds live parameters. dynamic_reconfigure has no nested names,
  /// so that each section has its own, in its namespace.
  struct Section {
    ros::NodeHandle handle;
    ros::Publisher descriptions, updates;
    ros::ServiceServer service;
  };

  void advertise(const std::string& section, const Describe& describe_defaults);
  bool set(const std::string& section, dynamic_reconfigure::Reconfigure::Request& request,
           dynamic_reconfigure::Reconfigure::Response& response);

  ros::NodeHandle handle_;
  Describe describe_;
  std::function<void()> changed_;
  std::mutex mutex_;  ///< guards the values and the order in which changes are reported
  std::map<std::string, Section> sections_;
};

}  // namespace internal

/// Writes the parameters of a node to the parameter server, and offers those that are marked Change::kLive to
/// the clients of dynamic_reconfigure (rqt_reconfigure, dynparam): service `set_parameters` and the latched
/// topics `parameter_descriptions` and `parameter_updates`, in the handle's namespace and below it in that of
/// every section with live parameters.
///
/// A value out of range is replaced by the nearest allowed one. A request with an invalid value (NaN, an
/// unknown choice) fails and changes nothing. A name that is unknown or not live is reported, and the other
/// values of the request take effect.
template <class Params>
class LiveParameters {
 public:
  using Changed = std::function<void(const Params&)>;

  /// Calls `changed` with `params` at once, and again after every change, from the threads that serve the
  /// handle's callbacks. Calls never overlap.
  LiveParameters(const ros::NodeHandle& handle, const Params& params, Changed changed)
      : params_(params),
        changed_(std::move(changed)),
        server_(
            handle, [this](ParameterVisitor& visitor) { params_.describe(visitor); },
            [](ParameterVisitor& visitor) { Params().describe(visitor); }, [this] { changed_(params_); }) {}
  LiveParameters(const LiveParameters&) = delete;
  LiveParameters& operator=(const LiveParameters&) = delete;

 private:
  Params params_;
  Changed changed_;
  internal::LiveParameterServer server_;
};

}  // namespace stereo_nav::ros_io
