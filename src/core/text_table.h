#pragma once

#include <string>
#include <vector>

namespace stereo_nav {

/// One line of a text file that holds more than white space and comment.
struct TextRow {
  std::string source;               ///< `file:line`, for messages
  std::vector<std::string> fields;  ///< separated by white space or commas

  /// Field as a finite number; throws InputError that names the line.
  double number(std::size_t column) const;
  /// Field as a count of nanoseconds or frames, exact beyond the 53 bits of a double; throws InputError.
  long long integer(std::size_t column) const;
};

/// Rows of a text file; `#` starts a comment anywhere, line ends may be of either kind. Throws
/// InputError when the file cannot be read.
std::vector<TextRow> readTextTable(const std::string& path);

}  // namespace stereo_nav
