#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>

#include "core/angles.h"
#include "core/planar_motion.h"
#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"
#include "tools/import_sequence/laser_sequence.h"
#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {
namespace {

/// A SICK LMS reports 81.8 to 81.9 m where nothing came back.
constexpr double kNoReturn_m = 80.0;
constexpr double kRangeMin_m = 0.05;
constexpr std::size_t kMostBeams = 10000;

/// The text of a file that may be compressed with gzip.
std::string readGzip(const std::string& path) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), gzclose);
  if (!file) throw InputError(path + ": cannot be read: " + std::strerror(errno));
  std::string text;
  char buffer[1 << 16];
  int read = 0;
  while ((read = gzread(file.get(), buffer, sizeof buffer)) > 0)
    text.append(buffer, static_cast<std::size_t>(read));
  if (read < 0)
    throw InputError(path + ": its compression is damaged or it is a folder; copy the file again");
  return text;
}

Eigen::Isometry2d poseFrom(const TextRow& row, std::size_t column) {
  Eigen::Isometry2d pose = Eigen::Isometry2d::Identity();
  pose.translation() << row.number(column), row.number(column + 1);
  pose.rotate(row.number(column + 2));
  return pose;
}

/// Adds a pose unless its stamp is not later than the last one.
bool append(Trajectory& trajectory, double time_s, const Eigen::Isometry2d& pose) {
  if (!trajectory.empty() && time_s <= trajectory.back().time_s) return false;
  trajectory.push_back({time_s, inSpace(pose)});
  return true;
}

class CarmenReader {
 public:
  LaserSequence read(const std::string& path) {
    std::istringstream text(readGzip(path));
    for (const TextRow& row : readTextTable(text, path)) {
      if (row.fields[0] == "ODOM") addOdometry(row);
      if (row.fields[0] == "FLASER") addScan(row);
    }
    addPending(std::numeric_limits<double>::infinity());
    if (sequence_.scans.size() < 2 || sequence_.wheels.size() < 2) {
      throw InputError(
          path + ": holds " + std::to_string(sequence_.scans.size()) + " FLASER and " +
          std::to_string(sequence_.wheels.size()) +
          " ODOM lines, needed are two of each; is it a CARMEN log of a robot with a front laser?");
    }
    const auto beams = static_cast<double>(sequence_.scans.front().ranges_m.size());
    sequence_.angle_min_rad = -0.5 * kPi;
    sequence_.angle_increment_rad = kPi / beams;
    sequence_.range_min_m = kRangeMin_m;
    sequence_.range_max_m = kNoReturn_m;
    return std::move(sequence_);
  }

 private:
  void addOdometry(const TextRow& row) {
    const Eigen::Isometry2d pose = poseFrom(row, 1);
    const double time_s = row.number(7);
    if (anchor_ && time_s > 0.0) T_start_base_ = T_start_base_ * (anchor_->inverse() * pose);
    anchor_ = pose;
    if (time_s > 0.0) pending_.push_back({kStartTime_s + time_s, inSpace(T_start_base_)});
  }

  void addScan(const TextRow& row) {
    const long long beams = row.integer(1);
    if (beams < 2 || beams > static_cast<long long>(kMostBeams)) {
      throw InputError(row.source + ": a FLASER line of " + row.fields[1] +
                       " beams; expected are 2 to 10000, is the line complete?");
    }
    const auto count = static_cast<std::size_t>(beams);
    if (!sequence_.scans.empty() && sequence_.scans.front().ranges_m.size() != count)
      throw InputError(row.source + ": the number of beams changes; split the log where the laser changes");
    LaserScanReading scan;
    scan.time_s = kStartTime_s + row.number(count + 8);
    for (std::size_t i = 0; i < count; ++i) {
      const double range_m = row.number(i + 2);
      scan.ranges_m.push_back(range_m < kNoReturn_m ? static_cast<float>(range_m)
                                                    : std::numeric_limits<float>::infinity());
    }
    addPending(scan.time_s);
    append(sequence_.wheels, scan.time_s, T_start_base_);
    if (append(sequence_.reference, scan.time_s, poseFrom(row, count + 2))) {
      sequence_.scans.push_back(std::move(scan));
    } else {
      ++sequence_.repeated;
    }
  }

  /// The order of the lines counts, their stamps jitter: at the scan's time the wheels are where the last
  /// line before it says.
  void addPending(double scan_s) {
    for (const StampedPose& wheels : pending_) {
      const bool in_order = wheels.time_s < scan_s &&
                            (sequence_.wheels.empty() || wheels.time_s > sequence_.wheels.back().time_s);
      if (in_order) sequence_.wheels.push_back(wheels);
    }
    pending_.clear();
  }

  LaserSequence sequence_{};
  Trajectory pending_;                       ///< wheels since the last scan
  std::optional<Eigen::Isometry2d> anchor_;  ///< where the next increment of the wheels starts
  Eigen::Isometry2d T_start_base_ = Eigen::Isometry2d::Identity();
};

}  // namespace

LaserSequence readCarmen(const std::string& log_file) {
  return CarmenReader().read(log_file);
}

}  // namespace stereo_nav::tools
