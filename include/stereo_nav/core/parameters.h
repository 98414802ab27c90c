#pragma once

#include <yaml-cpp/yaml.h>

#include <functional>
#include <string>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav {

/// One line of documentation, as printed by the tools and written into docs/.
struct ParameterDoc {
  std::string name;           ///< name including its sections, e.g. `corners.threshold`
  std::string type;           ///< bool, int, double, string or choice
  std::string default_value;  ///< the value in the struct when it was described
  std::string range;          ///< e.g. `1 to 255`
  std::string unit;           ///< empty for pure numbers
  std::string doc;            ///< its meaning
  bool live;                  ///< dynamic_reconfigure can change it on the running node
};

namespace internal {
using Describe = std::function<void(ParameterVisitor&)>;
void readYaml(const YAML::Node& node, const std::string& source, const Describe& describe);
void checkRanges(const std::string& source, const Describe& describe);
std::vector<ParameterDoc> document(const Describe& describe);
}  // namespace internal

/// Returns the content of a text file. Throws a ParameterError that says where the file was looked for.
std::string readTextFile(const std::string& path);

/// Parses YAML text. Throws a ParameterError that names `source` and the line of a syntax error.
YAML::Node parseYaml(const std::string& text, const std::string& source);

/// Parses a YAML file. Throws a ParameterError that names the file and the line of a syntax error.
YAML::Node loadYamlFile(const std::string& path);

/// Overwrites the fields of `params` that `node` (a map, or empty) holds. Throws ParameterError for an
/// unknown key, a wrong type or a value out of range. Messages name the origin of the values by `source`,
/// e.g. a file name.
template <class Params>
void readParameters(const YAML::Node& node, const std::string& source, Params& params) {
  internal::readYaml(node, source, [&params](ParameterVisitor& visitor) { params.describe(visitor); });
}

/// Checks values that were set in code. Throws ParameterError if one is out of range.
template <class Params>
void validateParameters(const Params& params, const std::string& source) {
  Params copy = params;
  internal::checkRanges(source, [&copy](ParameterVisitor& visitor) { copy.describe(visitor); });
}

/// Lists every field with its type, range, unit and default, and says whether it can be changed live.
template <class Params>
std::vector<ParameterDoc> documentParameters(const Params& params) {
  Params copy = params;
  return internal::document([&copy](ParameterVisitor& visitor) { copy.describe(visitor); });
}

}  // namespace stereo_nav
