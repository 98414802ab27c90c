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
  void add(const std::string& key, const JsonObject& value) { addText(key, value.text()); }

  std::string text() const { return members_.empty() ? "{}" : "{" + indented() + "\n}"; }

 private:
  /// In text that is not valid UTF-8 (file names may hold any bytes) the invalid bytes are replaced.
  static std::string textOf(const nlohmann::json& value) {
    return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  void addText(const std::string& key, const std::string& value) {
    members_.push_back(textOf(key) + ": " + value);
  }
  /// Every line of every member two columns to the right. The only line ends are those between members.
  std::string indented() const {
    std::string text;
    for (const auto& member : members_) {
      text += text.empty() ? "\n  " : ",\n  ";
      for (const char c : member) text += c == '\n' ? std::string("\n  ") : std::string(1, c);
    }
    return text;
  }

  std::vector<std::string> members_;
};

}  // namespace stereo_nav::eval
