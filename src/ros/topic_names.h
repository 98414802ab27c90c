#pragma once

#include <string>
#include <vector>

namespace stereo_nav::ros_io {

/// Throws ParameterError where a name cannot be part of a topic, or is there twice. `kind` begins the
/// message, e.g. "base: the joint".
void checkTopicNames(const std::vector<std::string>& names, const std::string& kind);

/// The same of items with a `name`.
template <class Item>
void checkTopicNames(const std::vector<Item>& items, const std::string& kind) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  checkTopicNames(names, kind);
}

}  // namespace stereo_nav::ros_io
