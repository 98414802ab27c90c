#pragma once

#include <gtest/gtest.h>

#include <string>

namespace stereo_nav::camera {

inline void expectContains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

}  // namespace stereo_nav::camera
