#include "tools/import_sequence/image_names.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numeric>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::tools {
namespace {

namespace fs = std::filesystem;

bool isDigit(char c) {
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

bool isLetter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

std::string digitsAt(const std::string& text, std::size_t begin) {
  std::size_t end = begin;
  while (end < text.size() && isDigit(text[end])) ++end;
  return text.substr(begin, end - begin);
}

std::string withoutZeros(const std::string& digits) {
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string::npos ? "0" : digits.substr(first);
}

/// The file's name in lower case, without extension and side.
std::string bareName(const std::string& path, Side side) {
  std::string name = fs::path(path).stem().string();
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const std::string word = side == Side::kLeft ? "left" : "right";
  const std::size_t at = name.find(word);
  if (at != std::string::npos) {
    name.erase(at, word.size());
  } else if (name.size() > 1 && name.back() == word[0] && !isLetter(name[name.size() - 2])) {
    name.pop_back();
  } else if (name.size() > 1 && name.front() == word[0] && !isLetter(name[1])) {
    name.erase(0, 1);
  }
  const std::size_t first = name.find_first_not_of("_-. ");
  const std::size_t last = name.find_last_not_of("_-. ");
  return first == std::string::npos ? std::string() : name.substr(first, last - first + 1);
}

bool keyLess(const std::string& a, const std::string& b) {
  return naturalLess(a, b);
}

using KeyedPaths = std::map<std::string, std::string, decltype(&keyLess)>;

KeyedPaths byKey(const std::vector<std::string>& paths, Side side) {
  KeyedPaths keyed(&keyLess);
  for (const std::string& path : paths) {
    const auto [entry, is_new] = keyed.emplace(pairKey(path, side), path);
    if (is_new) continue;
    throw InputError(path + ": has the same name or number as " + entry->second +
                     ", so that pairs cannot be told; remove one of the two");
  }
  return keyed;
}

/// Numbers of the keys, or nothing where one of them is no number that counts frames.
std::vector<std::uint64_t> numbersOf(const std::vector<std::string>& keys) {
  std::vector<std::uint64_t> numbers;
  for (const std::string& key : keys) {
    if (key.empty() || key.size() > 18 || !std::all_of(key.begin(), key.end(), isDigit)) return {};
    numbers.push_back(std::strtoull(key.c_str(), nullptr, 10));
  }
  return numbers;
}

/// Frames since the first one, by the numbers in the names; by their place in the list where the names hold
/// no numbers, or where so many are absent that they do not count frames.
std::vector<std::size_t> frameIndices(const std::vector<std::string>& keys) {
  std::vector<std::size_t> indices(keys.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  const auto numbers = numbersOf(keys);
  if (numbers.size() < 2) return indices;
  std::uint64_t step = 0;
  for (const std::uint64_t number : numbers) step = std::gcd(step, number - numbers.front());
  if ((numbers.back() - numbers.front()) / step + 1 > 2 * numbers.size()) return indices;
  for (std::size_t i = 0; i < keys.size(); ++i) indices[i] = (numbers[i] - numbers.front()) / step;
  return indices;
}

}  // namespace

bool naturalLess(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (isDigit(a[i]) && isDigit(b[j])) {
      const std::string left = digitsAt(a, i);
      const std::string right = digitsAt(b, j);
      const std::string left_number = withoutZeros(left);
      const std::string right_number = withoutZeros(right);
      if (left_number.size() != right_number.size()) return left_number.size() < right_number.size();
      if (left_number != right_number) return left_number < right_number;
      i += left.size();
      j += right.size();
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i;
      ++j;
    }
  }
  if (i < a.size() || j < b.size()) return j < b.size();
  return a < b;  // differ in leading zeros at most
}

std::string pairKey(const std::string& path, Side side) {
  const std::string name = bareName(path, side);
  std::string key;
  for (std::size_t i = 0; i < name.size();) {
    const std::string digits = digitsAt(name, i);
    key += digits.empty() ? name.substr(i, 1) : withoutZeros(digits);
    i += std::max<std::size_t>(1, digits.size());
  }
  return key;
}

std::optional<ros::Time> stampFromText(const std::string& text) {
  const std::string whole = digitsAt(text, 0);
  if (whole.empty() || whole.size() > 19) return std::nullopt;
  const std::uint64_t value = std::strtoull(whole.c_str(), nullptr, 10);
  std::uint64_t unit_ns = 1000000000ULL;
  std::uint64_t fraction_ns = 0;
  if (whole.size() < text.size()) {
    const std::string fraction = digitsAt(text, whole.size() + 1);
    if (text[whole.size()] != '.' || whole.size() + 1 + fraction.size() != text.size()) return std::nullopt;
    fraction_ns = std::strtoull((fraction + "000000000").substr(0, 9).c_str(), nullptr, 10);
  } else {
    if (value >= 100000000000ULL) unit_ns = 1000000ULL;
    if (value >= 100000000000000ULL) unit_ns = 1000ULL;
    if (value >= 100000000000000000ULL) unit_ns = 1ULL;
  }
  constexpr std::uint64_t kLatest_ns = 4294967294ULL * 1000000000ULL;  // ros::Time counts in 32 bits
  if (value > kLatest_ns / unit_ns) return std::nullopt;
  ros::Time stamp;
  return stamp.fromNSec(value * unit_ns + fraction_ns);
}

std::optional<ros::Time> stampFromName(const std::string& path, Side side) {
  const auto stamp = stampFromText(bareName(path, side));
  constexpr double kEarliest_s = 1e8, kLatest_s = 4e9;
  if (!stamp || stamp->toSec() < kEarliest_s || stamp->toSec() > kLatest_s) return std::nullopt;
  return stamp;
}

NamedPairs pairByName(const std::vector<std::string>& left, const std::vector<std::string>& right) {
  const KeyedPaths left_of = byKey(left, Side::kLeft);
  const KeyedPaths right_of = byKey(right, Side::kRight);
  KeyedPaths all = left_of;
  all.insert(right_of.begin(), right_of.end());
  std::vector<std::string> keys;
  for (const auto& entry : all) keys.push_back(entry.first);
  const auto indices = frameIndices(keys);
  NamedPairs pairs;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const auto l = left_of.find(keys[i]);
    const auto r = right_of.find(keys[i]);
    if (l == left_of.end() || r == right_of.end()) {
      pairs.unpaired.push_back(l == left_of.end() ? r->second : l->second);
      continue;
    }
    pairs.left.push_back(l->second);
    pairs.right.push_back(r->second);
    pairs.index.push_back(indices[i]);
  }
  pairs.absent = keys.empty() ? 0 : indices.back() + 1 - keys.size();
  return pairs;
}

std::string listOf(const std::vector<std::string>& paths) {
  constexpr std::size_t kShown = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(paths.size(), kShown); ++i) {
    const fs::path path(paths[i]);
    text += (i == 0 ? "" : ", ") + (path.parent_path().filename() / path.filename()).string();
  }
  if (paths.size() > kShown) text += " and " + std::to_string(paths.size() - kShown) + " more";
  return text;
}

}  // namespace stereo_nav::tools
