#include "ros/live_parameters.h"

#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/config_tools.h>
#include <ros/console.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <variant>
#include <vector>

#include "ros/parameter_server.h"

namespace stereo_nav::ros_io::internal {
namespace {

using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigTools;
using Value = std::variant<bool, int, double, std::string>;

struct LiveField {
  ParameterField field;
  Value value, min, max;
  std::vector<std::string> names;  ///< allowed values of a choice
};

/// The current section as a namespace, e.g. `uncertainty` or `a/b`.
std::string namespaceOf(const std::vector<std::string>& sections) {
  std::string path;
  for (const auto& section : sections) path += (path.empty() ? "" : "/") + section;
  return path;
}

/// All live fields, by section.
class LiveFieldCollector : public ParameterVisitor {
 public:
  std::map<std::string, std::vector<LiveField>> fields;

 private:
  void visit(const ParameterField& field, bool& value) override { add({field, value, false, true, {}}); }
  void visit(const ParameterField& field, int& value, Range<int> range) override {
    add({field, value, range.min, range.max, {}});
  }
  void visit(const ParameterField& field, double& value, Range<double> range) override {
    add({field, value, range.min, range.max, {}});
  }
  void visit(const ParameterField& field, std::string& value) override {
    add({field, value, std::string(), std::string(), {}});
  }
  void visit(const ParameterField& field, std::size_t& index,
             const std::vector<std::string>& names) override {
    add({field, names[index], std::string(), std::string(), names});
  }

  void add(const LiveField& live) {
    if (live.field.change == Change::kLive) fields[namespaceOf(sections())].push_back(live);
  }
};

std::vector<LiveField> collect(const Describe& describe, const std::string& section) {
  LiveFieldCollector collector;
  describe(collector);
  return collector.fields[section];
}

/// Assigns the values of a request to the live fields of one section.
class LiveFieldAssigner : public ParameterVisitor {
 public:
  LiveFieldAssigner(const Config& request, std::string section)
      : request_(request), section_(std::move(section)) {}

 private:
  void visit(const ParameterField& field, bool& value) override { find(field, value); }
  void visit(const ParameterField& field, int& value, Range<int> range) override {
    if (find(field, value)) value = std::clamp(value, range.min, range.max);
  }
  void visit(const ParameterField& field, double& value, Range<double> range) override {
    if (find(field, value)) value = std::clamp(value, range.min, range.max);
  }
  void visit(const ParameterField& field, std::string& value) override { find(field, value); }
  void visit(const ParameterField& field, std::size_t& index,
             const std::vector<std::string>& names) override {
    std::string chosen = names[index];
    find(field, chosen);
    index = static_cast<std::size_t>(std::find(names.begin(), names.end(), chosen) - names.begin());
  }

  template <class T>
  bool find(const ParameterField& field, T& value) const {
    return field.change == Change::kLive && namespaceOf(sections()) == section_ &&
           ConfigTools::getParameter(request_, field.name, value);
  }

  const Config& request_;
  std::string section_;
};

void append(Config& config, const std::string& name, const Value& value) {
  std::visit([&](const auto& typed) { ConfigTools::appendParameter(config, name, typed); }, value);
}

/// The one group that all parameters are in.
void appendGroup(Config& config) {
  dynamic_reconfigure::GroupState group;
  group.name = "Default";
  group.state = 1;
  config.groups.push_back(group);
}

Config toConfig(const std::vector<LiveField>& fields, Value LiveField::*member) {
  Config config;
  for (const auto& live : fields) append(config, live.field.name, live.*member);
  appendGroup(config);
  return config;
}

/// Description of a choice for the clients: a Python literal in the form that dynamic_reconfigure prescribes.
std::string editMethod(const LiveField& live) {
  if (live.names.empty()) return "";
  std::string items;
  for (const auto& name : live.names) {
    items += (items.empty() ? "" : ", ");
    items += "{'name': '" + name + "', 'value': '" + name + "', 'type': 'str', 'description': ''}";
  }
  return "{'enum': [" + items + "], 'enum_description': ''}";
}

dynamic_reconfigure::ConfigDescription toDescription(const std::vector<LiveField>& defaults) {
  static const char* const kTypes[] = {"bool", "int", "double", "str"};  // in the order of Value
  dynamic_reconfigure::Group group;
  group.name = "Default";
  for (const auto& live : defaults) {
    dynamic_reconfigure::ParamDescription parameter;
    parameter.name = live.field.name;
    parameter.type = kTypes[live.value.index()];
    parameter.description = live.field.doc + (live.field.unit.empty() ? "" : " (" + live.field.unit + ")");
    parameter.edit_method = editMethod(live);
    group.parameters.push_back(parameter);
  }
  dynamic_reconfigure::ConfigDescription description;
  description.groups.push_back(group);
  description.dflt = toConfig(defaults, &LiveField::value);
  description.min = toConfig(defaults, &LiveField::min);
  description.max = toConfig(defaults, &LiveField::max);
  return description;
}

/// The reason why the request must be refused; empty if it is valid.
std::string refusal(const Config& request, const std::vector<LiveField>& fields) {
  for (const auto& live : fields) {
    double number = 0.0;
    if (std::holds_alternative<double>(live.value) &&
        ConfigTools::getParameter(request, live.field.name, number) && std::isnan(number)) {
      return live.field.name + " is NaN, it must be a number";
    }
    std::string chosen;
    if (live.names.empty() || !ConfigTools::getParameter(request, live.field.name, chosen)) continue;
    if (std::find(live.names.begin(), live.names.end(), chosen) != live.names.end()) continue;
    std::string names;
    for (const auto& name : live.names) names += (names.empty() ? "" : " | ") + name;
    return live.field.name + " is '" + chosen + "', allowed is one of: " + names;
  }
  return "";
}

/// Names in the request that do not belong to a live parameter of that type.
std::string unknownNames(const Config& request, const std::vector<LiveField>& fields) {
  std::string unknown;
  const auto look = [&](const auto& values, std::size_t type) {
    for (const auto& value : values) {
      const bool known = std::any_of(fields.begin(), fields.end(), [&](const LiveField& live) {
        return live.field.name == value.name && live.value.index() == type;
      });
      if (!known) unknown += (unknown.empty() ? "" : ", ") + value.name;
    }
  };
  look(request.bools, 0);  // in the order of Value
  look(request.ints, 1);
  look(request.doubles, 2);
  look(request.strs, 3);
  return unknown;
}

}  // namespace

LiveParameterServer::LiveParameterServer(const ros::NodeHandle& handle, Describe describe,
                                         const Describe& describe_defaults, std::function<void()> changed)
    : handle_(handle), describe_(std::move(describe)), changed_(std::move(changed)) {
  const std::lock_guard<std::mutex> lock(mutex_);  // holds requests back until everything is set up
  writeParameters(handle_, describe_);
  LiveFieldCollector collector;
  describe_(collector);
  for (const auto& section : collector.fields) advertise(section.first, describe_defaults);
  changed_();
}

void LiveParameterServer::advertise(const std::string& section, const Describe& describe_defaults) {
  Section& offered = sections_[section];
  offered.handle = section.empty() ? handle_ : ros::NodeHandle(handle_, section);
  constexpr bool kLatched = true;
  offered.descriptions =
      offered.handle.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, kLatched);
  offered.descriptions.publish(toDescription(collect(describe_defaults, section)));
  offered.updates = offered.handle.advertise<Config>("parameter_updates", 1, kLatched);
  offered.updates.publish(toConfig(collect(describe_, section), &LiveField::value));
  using Reconfigure = dynamic_reconfigure::Reconfigure;
  const boost::function<bool(Reconfigure::Request&, Reconfigure::Response&)> serve =
      [this, section](Reconfigure::Request& request, Reconfigure::Response& response) {
        return set(section, request, response);
      };
  offered.service = offered.handle.advertiseService("set_parameters", serve);
}

bool LiveParameterServer::set(const std::string& section, dynamic_reconfigure::Reconfigure::Request& request,
                              dynamic_reconfigure::Reconfigure::Response& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Section& offered = sections_.at(section);
  const std::string service = offered.service.getService();
  const std::vector<LiveField> before = collect(describe_, section);
  const std::string problem = refusal(request.config, before);
  if (!problem.empty()) {
    ROS_ERROR_STREAM(service << ": nothing is changed: " << problem);
    return false;
  }
  const std::string unknown = unknownNames(request.config, before);
  if (!unknown.empty()) {
    ROS_ERROR_STREAM(service << ": unknown, of another type, or not changeable while the node runs: "
                             << unknown << ". docs/parameters.md marks what is live");
  }
  LiveFieldAssigner assigner(request.config, section);
  describe_(assigner);
  changed_();
  const std::vector<LiveField> after = collect(describe_, section);
  for (const auto& live : after) {
    std::visit([&](const auto& value) { offered.handle.setParam(live.field.name, value); }, live.value);
  }
  response.config = toConfig(after, &LiveField::value);
  offered.updates.publish(response.config);
  return true;
}

}  // namespace stereo_nav::ros_io::internal
