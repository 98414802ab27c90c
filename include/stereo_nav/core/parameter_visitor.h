#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stereo_nav {

/// A parameter that cannot be used; the message names the parameter, the value seen and what is allowed.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Both ends are allowed values.
template <class T>
struct Range {
  T min;  ///< smallest allowed value
  T max;  ///< largest allowed value
};

/// What every parameter struct tells about each of its fields, once, in its `describe(ParameterVisitor&)`.
/// Reading YAML, checking ranges and printing the documentation are visitors; none of them knows the structs.
class ParameterVisitor {
 public:
  virtual ~ParameterVisitor() = default;
  virtual void flag(const std::string& name, bool& value, const std::string& doc) = 0;
  virtual void integer(const std::string& name, int& value, Range<int> range, const std::string& unit,
                       const std::string& doc) = 0;
  virtual void real(const std::string& name, double& value, Range<double> range, const std::string& unit,
                    const std::string& doc) = 0;
  /// Free text: names of frames, topics, devices, files.
  virtual void text(const std::string& name, std::string& value, const std::string& doc) = 0;
  /// `index` counts into `names`.
  virtual void choice(const std::string& name, std::size_t& index, const std::vector<std::string>& names,
                      const std::string& doc) = 0;
  virtual void enterSection(const std::string& name) = 0;
  virtual void leaveSection() = 0;
};

/// A field of enumeration type; each value with its name in configuration files.
template <class Enum>
void visitEnum(ParameterVisitor& visitor, const std::string& name, Enum& value,
               const std::vector<std::pair<std::string, Enum>>& values, const std::string& doc) {
  std::vector<std::string> names;
  std::size_t index = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    names.push_back(values[i].first);
    if (values[i].second == value) index = i;
  }
  visitor.choice(name, index, names, doc);
  value = values[index].second;
}

/// A struct of parameters inside another one.
template <class Params>
void visitSection(ParameterVisitor& visitor, const std::string& name, Params& params) {
  visitor.enterSection(name);
  params.describe(visitor);
  visitor.leaveSection();
}

}  // namespace stereo_nav
