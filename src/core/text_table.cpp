#include "core/text_table.h"

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/trajectory.h"

namespace stereo_nav {
namespace {

std::vector<std::string> split(const std::string& line) {
  const char* separators = " \t\r,";
  std::vector<std::string> fields;
  std::size_t begin = line.find_first_not_of(separators);
  while (begin != std::string::npos) {
    const std::size_t end = line.find_first_of(separators, begin);
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(separators, end);
  }
  return fields;
}

const std::string& field(const TextRow& row, std::size_t column) {
  if (column < row.fields.size()) return row.fields[column];
  throw InputError(row.source + ": the line has " + std::to_string(row.fields.size()) +
                   " columns, at least " + std::to_string(column + 1) +
                   " are needed; is it of another format?");
}

}  // namespace

double TextRow::number(std::size_t column) const {
  const std::string& text = field(*this, column);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (*end == '\0' && std::isfinite(value)) return value;
  throw InputError(source + ": '" + text + "' is not a finite number");
}

long long TextRow::integer(std::size_t column) const {
  const std::string& text = field(*this, column);
  char* end = nullptr;
  errno = 0;
  const long long value = std::strtoll(text.c_str(), &end, 10);
  if (*end == '\0' && errno == 0) return value;
  throw InputError(source + ": '" + text + "' is not a whole number");
}

std::vector<TextRow> readTextTable(const std::string& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path)) {
    throw InputError(path +
                     ": cannot be read: " + (file ? "it is a folder" : std::string(std::strerror(errno))));
  }
  return readTextTable(file, path);
}

std::vector<TextRow> readTextTable(std::istream& text, const std::string& path) {
  std::vector<TextRow> rows;
  std::string line;
  for (int number = 1; std::getline(text, line); ++number) {
    auto fields = split(line.substr(0, line.find('#')));
    if (!fields.empty()) rows.push_back({path + ":" + std::to_string(number), std::move(fields)});
  }
  return rows;
}

}  // namespace stereo_nav
