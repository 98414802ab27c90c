#pragma once

#include <ros/time.h>

#include <optional>
#include <string>
#include <vector>

namespace stereo_nav::tools {

enum class Side { kLeft, kRight };

/// Order in which runs of digits count as numbers: `img9` comes before `img10`.
bool naturalLess(const std::string& a, const std::string& b);

/// Name of an image file without folder, extension, the word of its side (`left_007`, `007R`) and leading
/// zeros of its numbers: the two images of a pair have the same one.
std::string pairKey(const std::string& path, Side side);

/// A stamp written as a number: seconds with or without fraction, or whole milli-, micro- or nanoseconds,
/// told apart by their size. Nothing when the text is no such number.
std::optional<ros::Time> stampFromText(const std::string& text);

/// The date that is the name of an image file (`1403636579763555584.png`, `1403636579.7635.png`); nothing
/// when the name is no number or lies before 1973 or after 2096, and so is a count.
std::optional<ros::Time> stampFromName(const std::string& path, Side side);

/// Images that belong together by their names.
struct NamedPairs {
  std::vector<std::string> left;      ///< paths
  std::vector<std::string> right;     ///< paths, one for each left one
  std::vector<std::size_t> index;     ///< when each was taken, in frames since the first one
  std::vector<std::string> unpaired;  ///< paths of images that have no partner
  std::size_t absent = 0;             ///< numbers between the first and the last that neither folder has
};

/// Pairs of equal pairKey(), in their natural order. Where all keys are numbers, `index` counts by them, so
/// that an image that is missing leaves its time empty; the common step of the numbers is one frame. Throws
/// InputError when two images of one side have the same key.
NamedPairs pairByName(const std::vector<std::string>& left, const std::vector<std::string>& right);

/// "a, b, c and 4 more"; the last two parts of each path.
std::string listOf(const std::vector<std::string>& paths);

}  // namespace stereo_nav::tools
