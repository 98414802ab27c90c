#include "stereo_nav/core/parameters.h"

#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

namespace stereo_nav {
namespace {

template <class T>
std::string toText(const T& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

template <class T>
std::string toText(const Range<T>& range) {
  return toText(range.min) + " to " + toText(range.max);
}

std::string join(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : " | ") + name;
  return text;
}

/// Keeps track of the section a visitor is in, so that messages and documentation give full names.
class SectionedVisitor : public ParameterVisitor {
 public:
  void enterSection(const std::string& name) override { sections_.push_back(name); }
  void leaveSection() override { sections_.pop_back(); }

 protected:
  std::string fullName(const std::string& name) const {
    std::string full;
    for (const auto& section : sections_) full += section + ".";
    return full + name;
  }

 private:
  std::vector<std::string> sections_;
};

class RangeChecker : public SectionedVisitor {
 public:
  explicit RangeChecker(std::string source) : source_(std::move(source)) {}

  void flag(const std::string&, bool&, const std::string&) override {}
  void integer(const std::string& name, int& value, Range<int> range, const std::string& unit,
               const std::string& doc) override {
    check(name, value, range, unit, doc);
  }
  void real(const std::string& name, double& value, Range<double> range, const std::string& unit,
            const std::string& doc) override {
    check(name, value, range, unit, doc);
  }
  void text(const std::string&, std::string&, const std::string&) override {}
  void choice(const std::string&, std::size_t&, const std::vector<std::string>&,
              const std::string&) override {}

 private:
  template <class T>
  void check(const std::string& name, T value, Range<T> range, const std::string& unit,
             const std::string& doc) {
    if (value >= range.min && value <= range.max) return;  // false for NaN, too
    throw ParameterError(source_ + ": " + fullName(name) + " is " + toText(value) + ", allowed is " +
                         toText(range) + (unit.empty() ? "" : " " + unit) + " (" + doc + ")");
  }

  std::string source_;
};

class YamlReader : public SectionedVisitor {
 public:
  YamlReader(const YAML::Node& node, std::string source) : source_(std::move(source)) { push(node, ""); }

  void flag(const std::string& name, bool& value, const std::string&) override {
    assign(name, value, "true or false");
  }
  void integer(const std::string& name, int& value, Range<int>, const std::string&,
               const std::string&) override {
    assign(name, value, "a whole number");
  }
  void real(const std::string& name, double& value, Range<double>, const std::string&,
            const std::string&) override {
    assign(name, value, "a number");
  }
  void text(const std::string& name, std::string& value, const std::string&) override {
    assign(name, value, "a text");
  }
  void choice(const std::string& name, std::size_t& index, const std::vector<std::string>& names,
              const std::string&) override {
    std::string chosen = names[index];
    assign(name, chosen, "one of: " + join(names));
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == chosen) {
        index = i;
        return;
      }
    }
    throw ParameterError(source_ + ": " + fullName(name) + " is '" + chosen +
                         "', allowed is one of: " + join(names));
  }

  void enterSection(const std::string& name) override {
    levels_.back().known.insert(name);
    const YAML::Node& parent = levels_.back().node;
    const YAML::Node child = parent.IsMap() ? parent[name] : YAML::Node();
    SectionedVisitor::enterSection(name);
    push(child.IsDefined() ? child : YAML::Node(), fullName(""));
  }
  void leaveSection() override {
    refuseUnknownKeys();
    levels_.pop_back();
    SectionedVisitor::leaveSection();
  }

  void refuseUnknownKeys() const {
    const Level& level = levels_.back();
    if (!level.node.IsMap()) return;
    for (const auto& entry : level.node) {
      const auto key = entry.first.as<std::string>();
      if (level.known.count(key) == 0) {
        throw ParameterError(source_ + ": unknown parameter " + fullName(key) +
                             "; known here: " + join({level.known.begin(), level.known.end()}));
      }
    }
  }

 private:
  struct Level {
    YAML::Node node;
    std::set<std::string> known;
  };

  void push(const YAML::Node& node, const std::string& name) {
    if (node.IsDefined() && !node.IsNull() && !node.IsMap()) {
      throw ParameterError(source_ + ": " + (name.empty() ? "the file" : name) +
                           " must be a list of `name: value` lines");
    }
    levels_.push_back({node, {}});
  }

  template <class T>
  void assign(const std::string& name, T& value, const std::string& expected) {
    levels_.back().known.insert(name);
    const YAML::Node& parent = levels_.back().node;
    if (!parent.IsMap()) return;
    const YAML::Node node = parent[name];
    if (!node.IsDefined()) return;
    try {
      value = node.as<T>();
    } catch (const YAML::Exception&) {
      const std::string seen = node.IsScalar() ? "'" + node.Scalar() + "'" : "not a single value";
      throw ParameterError(source_ + ": " + fullName(name) + " is " + seen + ", must be " + expected);
    }
  }

  std::string source_;
  std::vector<Level> levels_;
};

class Documenter : public SectionedVisitor {
 public:
  void flag(const std::string& name, bool& value, const std::string& doc) override {
    docs.push_back({fullName(name), "bool", value ? "true" : "false", "", "", doc});
  }
  void integer(const std::string& name, int& value, Range<int> range, const std::string& unit,
               const std::string& doc) override {
    docs.push_back({fullName(name), "int", toText(value), toText(range), unit, doc});
  }
  void real(const std::string& name, double& value, Range<double> range, const std::string& unit,
            const std::string& doc) override {
    docs.push_back({fullName(name), "double", toText(value), toText(range), unit, doc});
  }
  void text(const std::string& name, std::string& value, const std::string& doc) override {
    docs.push_back({fullName(name), "string", value, "", "", doc});
  }
  void choice(const std::string& name, std::size_t& index, const std::vector<std::string>& names,
              const std::string& doc) override {
    docs.push_back({fullName(name), "choice", names[index], join(names), "", doc});
  }

  std::vector<ParameterDoc> docs;
};

}  // namespace

namespace internal {

void readYaml(const YAML::Node& node, const std::string& source, const Describe& describe) {
  YamlReader reader(node, source);
  describe(reader);
  reader.refuseUnknownKeys();
  checkRanges(source, describe);
}

void checkRanges(const std::string& source, const Describe& describe) {
  RangeChecker checker(source);
  describe(checker);
}

std::vector<ParameterDoc> document(const Describe& describe) {
  Documenter documenter;
  describe(documenter);
  return documenter.docs;
}

}  // namespace internal

YAML::Node loadYamlFile(const std::string& path) {
  try {
    return YAML::LoadFile(path);
  } catch (const YAML::BadFile&) {
    // roslaunch starts nodes in ROS_HOME, not in the folder that it was called from.
    const std::string where =
        std::filesystem::path(path).is_relative()
            ? " in " + std::filesystem::current_path().string() + " (launch files want absolute paths)"
            : "";
    throw ParameterError(path + ": cannot be read" + where +
                         "; does the file exist, and may this user read it?");
  } catch (const YAML::Exception& error) {
    throw ParameterError(path + ": not valid YAML: " + error.what());
  }
}

}  // namespace stereo_nav
