#pragma once

#include <string>

namespace stereo_nav {

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace stereo_nav
