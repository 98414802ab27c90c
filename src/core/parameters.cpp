#include "stereo_nav/core/parameters.h"

#include <cmath>
#include <filesystem>
#include <fstream>
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

class RangeChecker : public ParameterVisitor {
 public:
  explicit RangeChecker(std::string source) : source_(std::move(source)) {}

 private:
  void visit(const ParameterField&, bool&) override {}
  void visit(const ParameterField& field, int& value, Range<int> range) override {
    check(field, value, range);
  }
  void visit(const ParameterField& field, double& value, Range<double> range) override {
    check(field, value, range);
  }
  void visit(const ParameterField&, std::string&) override {}
  void visit(const ParameterField&, std::size_t&, const std::vector<std::string>&) override {}

  template <class T>
  void check(const ParameterField& field, T value, Range<T> range) const {
    if (value >= range.min && value <= range.max) return;  // false for NaN, too
    throw ParameterError(source_ + ": " + fullName(field.name) + " is " + toText(value) + ", allowed is " +
                         toText(range) + (field.unit.empty() ? "" : " " + field.unit) + " (" + field.doc +
                         ")");
  }

  std::string source_;
};

class YamlReader : public ParameterVisitor {
 public:
  YamlReader(const YAML::Node& node, std::string source) : source_(std::move(source)) { push(node, ""); }

  void enterSection(const std::string& name) override {
    levels_.back().known.insert(name);
    const YAML::Node& parent = levels_.back().node;
    const YAML::Node child = parent.IsMap() ? parent[name] : YAML::Node();
    ParameterVisitor::enterSection(name);
    push(child.IsDefined() ? child : YAML::Node(), fullName(""));
  }
  void leaveSection() override {
    refuseUnknownKeys();
    levels_.pop_back();
    ParameterVisitor::leaveSection();
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
  void visit(const ParameterField& field, bool& value) override {
    assign(field.name, value, "true or false");
  }
  void visit(const ParameterField& field, int& value, Range<int>) override {
    assign(field.name, value, "a whole number");
  }
  void visit(const ParameterField& field, double& value, Range<double>) override {
    assign(field.name, value, "a number");
  }
  void visit(const ParameterField& field, std::string& value) override {
    assign(field.name, value, "a text");
  }
  void visit(const ParameterField& field, std::size_t& index,
             const std::vector<std::string>& names) override {
    std::string chosen = names[index];
    assign(field.name, chosen, "one of: " + join(names));
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == chosen) {
        index = i;
        return;
      }
    }
    throw ParameterError(source_ + ": " + fullName(field.name) + " is '" + chosen +
                         "', allowed is one of: " + join(names));
  }

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

class Documenter : public ParameterVisitor {
 public:
  std::vector<ParameterDoc> docs;

 private:
  void visit(const ParameterField& field, bool& value) override {
    add(field, "bool", value ? "true" : "false", "");
  }
  void visit(const ParameterField& field, int& value, Range<int> range) override {
    add(field, "int", toText(value), toText(range));
  }
  void visit(const ParameterField& field, double& value, Range<double> range) override {
    add(field, "double", toText(value), toText(range));
  }
  void visit(const ParameterField& field, std::string& value) override { add(field, "string", value, ""); }
  void visit(const ParameterField& field, std::size_t& index,
             const std::vector<std::string>& names) override {
    add(field, "choice", names[index], join(names));
  }

  void add(const ParameterField& field, const std::string& type, const std::string& value,
           const std::string& range) {
    docs.push_back(
        {fullName(field.name), type, value, range, field.unit, field.doc, field.change == Change::kLive});
  }
};

/// Refuses names that are lists or maps themselves, which have no use here. An alias may hold itself, and
/// many aliases the same: hence the limits.
class NameCheck {
 public:
  explicit NameCheck(const std::string& source) : source_(source) {}

  void check(const YAML::Node& node, int depth = 0) {
    constexpr int kDeepest = 50, kMostNodes = 1000000;
    if (depth > kDeepest || ++nodes_ > kMostNodes)
      throw ParameterError(source_ + ": too deep or too large; does an alias hold itself?");
    if (node.IsSequence()) {
      for (const YAML::Node& item : node) check(item, depth + 1);
    }
    if (!node.IsMap()) return;
    for (const auto& entry : node) {
      if (!entry.first.IsScalar()) {
        throw ParameterError(source_ + ": line " + std::to_string(entry.first.Mark().line + 1) +
                             ": expected is a name with a colon behind it, not a list or a map; is the "
                             "indentation right?");
      }
      check(entry.second, depth + 1);
    }
  }

 private:
  const std::string& source_;
  int nodes_ = 0;
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

std::string readTextFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (file && !text.bad()) return text.str();
  // roslaunch starts nodes in ROS_HOME, not in the folder in which it was called.
  const std::string where =
      std::filesystem::path(path).is_relative()
          ? " in " + std::filesystem::current_path().string() + " (launch files want absolute paths)"
          : "";
  throw ParameterError(path + ": cannot be read" + where +
                       "; does the file exist, and may this user read it?");
}

YAML::Node parseYaml(const std::string& text, const std::string& source) {
  try {
    YAML::Node root = YAML::Load(text);
    NameCheck(source).check(root);
    return root;
  } catch (const YAML::Exception& error) {
    throw ParameterError(source + ": not valid YAML: " + error.what());
  }
}

YAML::Node loadYamlFile(const std::string& path) {
  return parseYaml(readTextFile(path), path);
}

}  // namespace stereo_nav
