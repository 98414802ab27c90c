#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace stereo_nav {

/// Thrown for a parameter that cannot be used. The message names the parameter, the value seen and what is
/// allowed.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Range of a parameter. Both ends are allowed values.
template <class T>
struct Range {
  T min;  ///< smallest allowed value
  T max;  ///< largest allowed value
};

/// When a new value of a parameter takes effect.
enum class Change {
  kAtStart,  ///< the node reads it once, when it starts
  kLive,     ///< dynamic_reconfigure can change it on the running node, too
};

/// What a parameter struct says about a field besides its value and range.
struct ParameterField {
  std::string name;  ///< as in configuration files, without its sections
  std::string unit;  ///< empty for pure numbers
  std::string doc;   ///< its meaning, for the documentation
  Change change;     ///< whether it may change on a running node
};

/// Receives the description of each field of a parameter struct, which the struct gives once, in its
/// `describe(ParameterVisitor&)`. Reading YAML, checking ranges, dynamic_reconfigure and the documentation
/// are visitors; none of them knows the structs.
class ParameterVisitor {
 public:
  virtual ~ParameterVisitor() = default;

  /// A field that is true or false.
  void flag(const std::string& name, bool& value, const std::string& doc, Change change = Change::kAtStart) {
    visit({name, "", doc, change}, value);
  }
  /// A field that is a whole number.
  void integer(const std::string& name, int& value, Range<int> range, const std::string& unit,
               const std::string& doc, Change change = Change::kAtStart) {
    visit({name, unit, doc, change}, value, range);
  }
  /// A field that is a real number.
  void real(const std::string& name, double& value, Range<double> range, const std::string& unit,
            const std::string& doc, Change change = Change::kAtStart) {
    visit({name, unit, doc, change}, value, range);
  }
  /// A field with free text: the name of a frame, topic, device or file.
  void text(const std::string& name, std::string& value, const std::string& doc,
            Change change = Change::kAtStart) {
    visit({name, "", doc, change}, value);
  }
  /// A field that takes one of `names`; `index` is the position of its value in `names`.
  void choice(const std::string& name, std::size_t& index, const std::vector<std::string>& names,
              const std::string& doc, Change change = Change::kAtStart) {
    visit({name, "", doc, change}, index, names);
  }
  /// Begins the section `name`: the fields that follow, up to leaveSection(), belong to it.
  virtual void enterSection(const std::string& name) { sections_.push_back(name); }
  /// Ends the section that was entered last.
  virtual void leaveSection() { sections_.pop_back(); }

 protected:
  /// The name including its sections, e.g. `corners.threshold`.
  std::string fullName(const std::string& name) const {
    std::string full;
    for (const auto& section : sections_) full += section + ".";
    return full + name;
  }
  /// The sections from the outermost to the current one; empty outside of all sections.
  const std::vector<std::string>& sections() const { return sections_; }

 private:
  virtual void visit(const ParameterField& field, bool& value) = 0;
  virtual void visit(const ParameterField& field, int& value, Range<int> range) = 0;
  virtual void visit(const ParameterField& field, double& value, Range<double> range) = 0;
  virtual void visit(const ParameterField& field, std::string& value) = 0;
  virtual void visit(const ParameterField& field, std::size_t& index,
                     const std::vector<std::string>& names) = 0;

  std::vector<std::string> sections_;
};

/// Visits a field of enumeration type. `names` pairs each value with its name in configuration files.
template <class Enum>
void visitEnum(ParameterVisitor& visitor, const std::string& name, Enum& value,
               const std::vector<std::pair<std::string, Enum>>& values, const std::string& doc,
               Change change = Change::kAtStart) {
  std::vector<std::string> names;
  std::size_t index = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    names.push_back(values[i].first);
    if (values[i].second == value) index = i;
  }
  visitor.choice(name, index, names, doc, change);
  value = values[index].second;
}

/// Visits a parameter struct that is a member of another one.
template <class Params>
void visitSection(ParameterVisitor& visitor, const std::string& name, Params& params) {
  visitor.enterSection(name);
  params.describe(visitor);
  visitor.leaveSection();
}

}  // namespace stereo_nav
