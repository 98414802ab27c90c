#include "sensors/laser/scan_assembler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stereo_nav::laser {
namespace {

constexpr double kFullTurn_deg = 360.0;
/// Headings deviate from the even turning by some degrees: a revolution is complete when the even turning has
/// passed its end by as much.
constexpr double kMargin_deg = 8.0;
/// A revolution with fewer nodes has no times worth the name.
constexpr std::size_t kMinNodes = 10;

}  // namespace

void ScanParams::describe(ParameterVisitor& visitor) {
  visitor.integer("beams", beams, {36, 3600}, "",
                  "beams of a scan, evenly spaced; about the samples of a revolution");
  visitor.real("range_min_m", range_min_m, {0.0, 100.0}, "m", "nearer measurements become -Inf (REP-117)");
  visitor.real("range_max_m", range_max_m, {0.1, 100.0}, "m", "farther measurements become +Inf (REP-117)");
}

void ScanAssembler::reset() {
  nodes_.clear();
  begun_ = whole_ = false;
}

void ScanAssembler::push(const FramedNode& node, double time_s, const Sink& sink) {
  if (node.restarted) reset();
  if (!begun_) {
    begun_ = true;
    end_deg_ = kFullTurn_deg * (std::floor(node.turned_deg / kFullTurn_deg) + 1.0);
  }
  nodes_.push_back({node.turned_deg, time_s, rangeOf(node.node), static_cast<float>(node.node.quality)});
  if (node.expected_turned_deg > end_deg_ + kMargin_deg) finish(sink);
}

float ScanAssembler::rangeOf(const ScanNode& node) const {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const double range_m = 1e-3 * node.distance_mm;
  if (node.distance_mm == 0.0) return std::numeric_limits<float>::quiet_NaN();
  if (range_m < params_.range_min_m) return -kInfinity;
  if (range_m > params_.range_max_m) return kInfinity;
  return static_cast<float>(range_m);
}

void ScanAssembler::finish(const Sink& sink) {
  const auto next = std::stable_partition(nodes_.begin(), nodes_.end(),
                                          [&](const TimedNode& node) { return node.turned_deg < end_deg_; });
  const auto count = static_cast<std::size_t>(next - nodes_.begin());
  const double start_deg = end_deg_ - kFullTurn_deg;
  if (whole_ && count >= kMinNodes) {
    const auto beams = static_cast<std::size_t>(params_.beams);
    Scan scan;
    scan.ranges_m.assign(beams, std::numeric_limits<float>::quiet_NaN());
    scan.qualities.assign(beams, 0.0F);
    offsets_.assign(beams, std::numeric_limits<double>::infinity());
    for (auto node = nodes_.begin(); node != next; ++node) {
      const double position = (node->turned_deg - start_deg) / kFullTurn_deg * params_.beams;
      const double offset = std::abs(position - std::round(position));
      // The last half of a beam belongs to the first one, which is a whole turn away in time: it is left out.
      const auto beam = static_cast<std::ptrdiff_t>(std::lround(position));
      if (beam < 0 || beam >= params_.beams || offset >= offsets_[static_cast<std::size_t>(beam)]) continue;
      offsets_[static_cast<std::size_t>(beam)] = offset;
      scan.ranges_m[static_cast<std::size_t>(beam)] = node->range_m;
      scan.qualities[static_cast<std::size_t>(beam)] = node->quality;
    }
    setTimes(count, scan);
    sink(scan);
  }
  nodes_.erase(nodes_.begin(), next);
  end_deg_ += kFullTurn_deg;
  whole_ = true;
}

/// Least squares of time over heading.
void ScanAssembler::setTimes(std::size_t nodes, Scan& scan) const {
  const double start_deg = end_deg_ - kFullTurn_deg;
  const double start_s = nodes_.front().time_s;
  double mean_deg = 0.0, mean_s = 0.0;
  for (std::size_t i = 0; i < nodes; ++i) {
    mean_deg += (nodes_[i].turned_deg - start_deg) / static_cast<double>(nodes);
    mean_s += (nodes_[i].time_s - start_s) / static_cast<double>(nodes);
  }
  double products = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < nodes; ++i) {
    const double turned = nodes_[i].turned_deg - start_deg - mean_deg;
    products += turned * (nodes_[i].time_s - start_s - mean_s);
    squares += turned * turned;
  }
  const double seconds_per_degree = squares > 0.0 ? products / squares : 0.0;
  scan.time_s = start_s + mean_s - seconds_per_degree * mean_deg;
  scan.scan_time_s = seconds_per_degree * kFullTurn_deg;
  scan.time_increment_s = scan.scan_time_s / params_.beams;
}

}  // namespace stereo_nav::laser
