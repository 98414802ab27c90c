#pragma once

#include <istream>
#include <string>
#include <vector>

namespace stereo_nav {

/// One line of a text file that holds more than white space and comments.
struct TextRow {
  std::string source;               ///< `file:line`, for messages
  std::vector<std::string> fields;  ///< separated by white space or commas

  /// Returns a field as a finite number. Throws an InputError that names the line.
  double number(std::size_t column) const;
  /// Returns a field as a whole number, exact beyond the 53 bits of a double, as counts of nanoseconds need.
  /// Throws InputError.
  long long integer(std::size_t column) const;
};

/// Reads the rows of a text file. `#` starts a comment anywhere; line ends may be of either kind. Throws
/// InputError when the file cannot be read.
std::vector<TextRow> readTextTable(const std::string& path);
/// The same of a text that is read already; `path` names it in messages.
std::vector<TextRow> readTextTable(std::istream& text, const std::string& path);

}  // namespace stereo_nav
