#pragma once

#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <ros/service.h>

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::test {

using Value = std::variant<bool, int, double, std::string>;

/// A live parameter as its struct describes it; `section` as a namespace, with a slash in front, or empty.
struct LiveParameter {
  std::string section, name;
  Value value, min, max;
};

/// The live parameters of a struct, with the values it has.
class LiveParameterList : public ParameterVisitor {
 public:
  template <class Params>
  static std::vector<LiveParameter> of(Params params) {
    LiveParameterList list;
    params.describe(list);
    return list.parameters_;
  }

 private:
  void visit(const ParameterField& field, bool& value) override { add(field, value, false, true); }
  void visit(const ParameterField& field, int& value, Range<int> range) override {
    add(field, value, range.min, range.max);
  }
  void visit(const ParameterField& field, double& value, Range<double> range) override {
    add(field, value, range.min, range.max);
  }
  void visit(const ParameterField& field, std::string& value) override {
    add(field, value, std::string(), std::string());
  }
  void visit(const ParameterField& field, std::size_t& index,
             const std::vector<std::string>& names) override {
    add(field, names[index], std::string(), std::string());
  }

  void add(const ParameterField& field, const Value& value, const Value& min, const Value& max) {
    if (field.change != Change::kLive) return;
    std::string section;
    for (const auto& name : sections()) section += "/" + name;
    parameters_.push_back({section, field.name, value, min, max});
  }

  std::vector<LiveParameter> parameters_;
};

inline std::map<std::string, Value> valuesOf(const dynamic_reconfigure::Config& config) {
  std::map<std::string, Value> values;
  for (const auto& entry : config.bools) values[entry.name] = entry.value != 0;
  for (const auto& entry : config.ints) values[entry.name] = entry.value;
  for (const auto& entry : config.doubles) values[entry.name] = entry.value;
  for (const auto& entry : config.strs) values[entry.name] = entry.value;
  return values;
}

/// The values of the node after the request; nothing if the service is missing or refuses.
inline std::optional<std::map<std::string, Value>> reconfigure(const std::string& node,
                                                               const std::map<std::string, Value>& values) {
  dynamic_reconfigure::Reconfigure service;
  for (const auto& entry : values) {
    std::visit(
        [&](const auto& value) {
          dynamic_reconfigure::ConfigTools::appendParameter(service.request.config, entry.first, value);
        },
        entry.second);
  }
  ros::service::waitForService(node + "/set_parameters", ros::Duration(60.0));  // for a loaded machine
  if (!ros::service::call(node + "/set_parameters", service)) return std::nullopt;
  return valuesOf(service.response.config);
}

}  // namespace stereo_nav::test
