#pragma once

#include <stdexcept>
#include <string>

namespace stereo_nav::eval {

/// A picture that could not be drawn; one line with the remedy.
class GnuplotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Runs the program gnuplot on a script (which sets its terminal to svg and no output file) and returns the
/// SVG. Its files live beside `path_prefix` while it runs. Throws GnuplotError.
std::string runGnuplot(const std::string& script, const std::string& path_prefix);

}  // namespace stereo_nav::eval
