#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace stereo_nav::eval {

/// A JSON object that keeps the order in which its keys were added (nlohmann::ordered_json is younger than
/// Ubuntu 20.04's library). Numbers are written in the shortest form that reads back as the same double, NaN
/// as null.
class JsonObject {
 public:
  template <class Value>
  void add(const std::string& key, const Value& value) {
    addText(key, textOf(value));
  }
  void add(const std::string& key, const JsonObject& value) { addText(key, value.text(1)); }

  std::string text(int depth = 0) const {
    const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
    return members_.empty() ? "{}" : "{" + indented(indent + "  ") + "\n" + indent + "}";
  }

 private:
  /// In text that is not valid UTF-8 (file names may hold any bytes) the invalid bytes are replaced.
  static std::string textOf(const nlohmann::json& value) {
    return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  void addText(const std::string& key, const std::string& value) {
    members_.push_back(textOf(key) + ": " + value);
  }
  std::string indented(const std::string& indent) const {
    std::string text;
    for (const auto& member : members_)
      text.append(text.empty() ? "\n" : ",\n").append(indent).append(member);
    return text;
  }

  std::vector<std::string> members_;
};

}  // namespace stereo_nav::eval
