#pragma once

#include <stdexcept>

namespace stereo_nav {

/// Thrown for a file, message or recording that cannot be used. The text is one line that says what was seen,
/// the likely cause and the remedy.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace stereo_nav
