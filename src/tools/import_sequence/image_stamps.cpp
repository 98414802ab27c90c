#include "tools/import_sequence/image_stamps.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::tools {
namespace {

constexpr double kDefaultRate_hz = 10.0;
constexpr double kFirstDate_s = 1e6;  ///< stamps before it count from the start of the recording

using Stamps = std::vector<ros::Time>;

/// Stamps that all names of a folder are, in order of time; empty where one name is no date.
Stamps stampsFromNames(const std::vector<std::string>& paths, Side side) {
  Stamps stamps;
  for (const std::string& path : paths) {
    const auto stamp = stampFromName(path, side);
    if (!stamp || (!stamps.empty() && *stamp <= stamps.back())) return {};
    stamps.push_back(*stamp);
  }
  return stamps;
}

/// A column of times.txt, one stamp for each index.
Stamps readTimes(const std::vector<TextRow>& rows, std::size_t column) {
  Stamps stamps;
  for (const TextRow& row : rows) {
    auto stamp = column < row.fields.size() ? stampFromText(row.fields[column]) : std::nullopt;
    if (!stamp) {
      // Numbers such as 1.2e-1 are no plain stamps; their precision is that of a double.
      const double time_s = row.number(column);
      if (!(time_s >= 0.0 && time_s < 4e9)) {
        throw InputError(row.source + ": the stamp " + row.fields[column] + " is no time in seconds");
      }
      stamp = ros::Time(time_s);
    }
    if (rows.front().number(column) < kFirstDate_s) *stamp += ros::Duration(kStartTime_s);
    if (!stamps.empty() && *stamp <= stamps.back()) {
      throw InputError(row.source + ": the stamp " + row.fields[column] +
                       " is not later than the one before");
    }
    stamps.push_back(*stamp);
  }
  return stamps;
}

Stamps pick(const Stamps& stamps, const std::vector<std::size_t>& indices) {
  Stamps picked;
  for (const std::size_t index : indices) picked.push_back(stamps[index]);
  return picked;
}

void stampFromFile(const std::string& path, const NamedPairs& pairs, Sequence& sequence) {
  const auto rows = readTextTable(path);
  if (rows.size() != pairs.index.back() + 1) {
    throw InputError(path + ": holds " + std::to_string(rows.size()) + " stamps for " +
                     std::to_string(pairs.index.back() + 1) +
                     " frames (counted from the first name to the last); give one line for each frame");
  }
  const bool two_columns = rows.front().fields.size() > 1;
  sequence.left.stamps = pick(readTimes(rows, 0), pairs.index);
  sequence.right.stamps = pick(readTimes(rows, two_columns ? 1 : 0), pairs.index);
}

void stampFromRate(const NamedPairs& pairs, std::optional<double> rate_hz, Sequence& sequence) {
  if (!rate_hz) {
    sequence.notes.push_back("calib.txt has no line 'fps': the images are stamped at 10 Hz");
  }
  for (const std::size_t index : pairs.index) {
    sequence.left.stamps.push_back(stampOfIndex(index, rate_hz.value_or(kDefaultRate_hz)));
  }
  sequence.right.stamps = sequence.left.stamps;
}

void addNotes(const NamedPairs& pairs, Sequence& sequence) {
  if (!pairs.unpaired.empty()) {
    sequence.notes.push_back(
        std::to_string(pairs.unpaired.size()) +
        " images have no partner of the same name and are left out: " + listOf(pairs.unpaired));
  }
  if (pairs.absent > 0) {
    sequence.notes.push_back(std::to_string(pairs.absent) +
                             " numbers between the first and the last image are missing in both folders; "
                             "their time stays empty");
  }
}

}  // namespace

ros::Time stampOfIndex(std::size_t index, double rate_hz) {
  ros::Time stamp;
  return stamp.fromNSec(
      static_cast<std::uint64_t>(std::llround((kStartTime_s + static_cast<double>(index) / rate_hz) * 1e9)));
}

void readImageFolders(const std::string& folder, std::optional<double> rate_hz, Sequence& sequence) {
  const auto left = listImages(folder + "/left");
  const auto right = listImages(folder + "/right");
  NamedPairs pairs = pairByName(left, right);
  const Stamps left_dates = stampsFromNames(left, Side::kLeft);
  const Stamps right_dates = stampsFromNames(right, Side::kRight);
  const bool dated = !left_dates.empty() && !right_dates.empty();
  const std::string times = folder + "/times.txt";
  const bool has_times = std::filesystem::exists(times);
  if (dated && !has_times && 2 * pairs.left.size() < std::min(left.size(), right.size())) {
    sequence.notes.push_back("the names of the images are their stamps; each camera has its own");
    sequence.left.stamps = left_dates;
    sequence.right.stamps = right_dates;
    sequence.left.frames = readImageFiles(left);
    sequence.right.frames = readImageFiles(right);
    return;
  }
  if (pairs.left.empty()) {
    throw InputError(folder + ": no image in left/ has the name of one in right/ (" + listOf({left.front()}) +
                     ", " + listOf({right.front()}) + "); give the two images of a pair the same name");
  }
  addNotes(pairs, sequence);
  if (has_times) {
    stampFromFile(times, pairs, sequence);
  } else if (dated) {
    sequence.notes.push_back("the names of the images are their stamps");
    sequence.left.stamps = stampsFromNames(pairs.left, Side::kLeft);
    sequence.right.stamps = stampsFromNames(pairs.right, Side::kRight);
  } else {
    stampFromRate(pairs, rate_hz, sequence);
  }
  sequence.left.frames = readImageFiles(std::move(pairs.left));
  sequence.right.frames = readImageFiles(std::move(pairs.right));
}

}  // namespace stereo_nav::tools
