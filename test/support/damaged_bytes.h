#pragma once

#include <algorithm>
#include <random>
#include <string>

namespace stereo_nav::test {

/// The bytes with one damage of a kind that files meet: bits turned, bytes lost, doubled, set to zero, pieces
/// exchanged, the end cut off or something appended. The same generator gives the same damages.
inline std::string damaged(std::string bytes, std::mt19937& generator) {
  const auto below = [&generator](std::size_t limit) { return limit == 0 ? 0 : generator() % limit; };
  const std::size_t at = below(bytes.size());
  const std::size_t length = 1 + below(std::min<std::size_t>(64, bytes.size() - at));
  switch (generator() % 7) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 1:
      bytes.erase(at, length);
      break;
    case 2:
      bytes.insert(at, bytes.substr(at, length));
      break;
    case 3:
      std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), length, '\0');
      break;
    case 4:
      bytes.resize(at);
      break;
    case 5:
      bytes.append(length, static_cast<char>(generator()));
      break;
    default:
      bytes.replace(at, length, bytes.substr(below(bytes.size() - length), length));
      break;
  }
  return bytes;
}

}  // namespace stereo_nav::test
