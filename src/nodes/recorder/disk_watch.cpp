#include "nodes/recorder/disk_watch.h"

#include <fmt/format.h>

#include <algorithm>

namespace stereo_nav::nodes {
namespace {

constexpr double kWindow_s = 10.0;
constexpr double kSilence_s = 5.0;  // the recorder writes chunks that hold less than a second of images

constexpr double kMega = 1e6, kGiga = 1e9;

}  // namespace

void DiskWatch::add(double time_s, std::uint64_t bytes_written, std::uint64_t bytes_free) {
  samples_.push_back({time_s, bytes_written, bytes_free});
  while (samples_.size() > 2 && time_s - samples_[1].time_s >= kWindow_s) samples_.pop_front();
}

double DiskWatch::rate() const {
  if (samples_.size() < 2) return 0.0;
  const Sample &first = samples_.front(), &last = samples_.back();
  if (last.written <= first.written || last.time_s <= first.time_s) return 0.0;
  return static_cast<double>(last.written - first.written) / (last.time_s - first.time_s);
}

std::optional<double> DiskWatch::secondsLeft() const {
  const double bytes_per_s = rate();
  if (bytes_per_s <= 0.0) return std::nullopt;
  const std::uint64_t usable = bytesFree() - std::min(bytesFree(), reserve_bytes_);
  return static_cast<double>(usable) / bytes_per_s;
}

DiskWatch::State DiskWatch::state() const {
  if (samples_.empty()) return State::kStarting;
  if (bytesFree() <= reserve_bytes_) return State::kFull;
  const auto left = secondsLeft();
  if (left && *left < warn_before_s_) return State::kLow;
  // In the first seconds the rate is too low, since topics are still being connected.
  if (samples_.back().time_s - samples_.front().time_s < kSilence_s) return State::kStarting;
  return left ? State::kGood : State::kSilent;
}

std::string DiskWatch::text() const {
  const double rate_mb_s = rate() / kMega, free_gb = static_cast<double>(bytesFree()) / kGiga;
  switch (state()) {
    case State::kStarting:
      return "recording starts";
    case State::kFull:
      return fmt::format(
          "the disk is full: {:.2f} GB free, of which {:.2f} GB are reserved; nothing more is recorded. "
          "Delete old recordings or record to another disk",
          free_gb, static_cast<double>(reserve_bytes_) / kGiga);
    case State::kSilent:
      return "nothing is written, because no message arrives. Do the cameras run? Look at `rostopic hz "
             "camera/left/image_raw` and /diagnostics";
    case State::kLow:
      return fmt::format(
          "the disk is full in {:.1f} min at {:.1f} MB/s ({:.1f} GB free): end the recording soon, delete "
          "old ones, or record mono8 images",
          *secondsLeft() / 60.0, rate_mb_s, free_gb);
    case State::kGood:
      break;
  }
  return fmt::format("recording {:.1f} MB/s, {:.2f} GB written, the disk lasts {:.0f} min ({:.1f} GB free)",
                     rate_mb_s, static_cast<double>(bytesWritten()) / kGiga, *secondsLeft() / 60.0, free_gb);
}

}  // namespace stereo_nav::nodes
