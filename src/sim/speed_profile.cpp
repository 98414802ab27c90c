#include "sim/speed_profile.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::sim {
namespace {

/// Speeds at points of the curve that respect the limits in both directions of travel.
std::vector<double> limitedSpeeds(double step_m, std::size_t points,
                                  const std::function<double(double)>& curvature, const SpeedLimits& limits) {
  std::vector<double> speeds;
  for (std::size_t i = 0; i < points; ++i) {
    const double arc = step_m * static_cast<double>(i);
    const double wavering =
        1.0 + limits.variation * (0.6 * std::sin(2.3 * arc) + 0.4 * std::sin(5.9 * arc + 1.0));
    const double in_curve = limits.yaw_rate_rps / std::max(std::fabs(curvature(arc)), 1e-6);
    speeds.push_back(std::min(limits.speed_m_s * wavering, in_curve));
  }
  const auto reachable = [&](double from) {
    return std::sqrt(from * from + 2.0 * limits.acceleration_mps2 * step_m);
  };
  speeds.front() = speeds.back() = 0.0;
  for (std::size_t i = 1; i < points; ++i) speeds[i] = std::min(speeds[i], reachable(speeds[i - 1]));
  for (std::size_t i = points - 1; i-- > 0;) speeds[i] = std::min(speeds[i], reachable(speeds[i + 1]));
  return speeds;
}

/// Moving mean over `width` values; the sum stays the same, the series gets longer by width - 1.
std::vector<double> spread(const std::vector<double>& values, std::size_t width) {
  std::vector<double> result(values.size() + width - 1, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t k = 0; k < width; ++k) result[i + k] += values[i] / static_cast<double>(width);
  }
  return result;
}

}  // namespace

SpeedProfile::SpeedProfile(double length_m, const std::function<double(double)>& curvature,
                           const SpeedLimits& limits) {
  const std::size_t points = static_cast<std::size_t>(std::ceil(length_m / 0.005)) + 1;
  const double step_m = length_m / static_cast<double>(points - 1);
  const std::vector<double> speeds = limitedSpeeds(step_m, points, curvature, limits);

  // Distances at even times of the unsmoothed profile.
  std::vector<double> travelled{0.0};
  double time_s = 0.0;
  for (std::size_t i = 1; i < points; ++i) {
    const double takes_s = 2.0 * step_m / (speeds[i - 1] + speeds[i]);
    for (double next_s; (next_s = kStep_s * static_cast<double>(travelled.size())) <= time_s + takes_s;) {
      const double t = next_s - time_s, gain = (speeds[i] - speeds[i - 1]) / takes_s;
      travelled.push_back(step_m * static_cast<double>(i - 1) + speeds[i - 1] * t + 0.5 * gain * t * t);
    }
    time_s += takes_s;
  }
  travelled.push_back(length_m);

  std::vector<double> increments;
  for (std::size_t i = 1; i < travelled.size(); ++i) increments.push_back(travelled[i] - travelled[i - 1]);
  constexpr std::size_t kSmoothing = 15;  // two means of 0.15 s each
  increments = spread(spread(increments, kSmoothing), kSmoothing);

  arc_m_.push_back(0.0);
  speed_m_s_.push_back(0.0);
  for (std::size_t i = 0; i < increments.size(); ++i) {
    arc_m_.push_back(arc_m_.back() + increments[i]);
    const double next = i + 1 < increments.size() ? increments[i + 1] : 0.0;
    speed_m_s_.push_back(0.5 * (increments[i] + next) / kStep_s);
  }
  speed_m_s_.back() = 0.0;
}

double SpeedProfile::duration_s() const {
  return kStep_s * static_cast<double>(arc_m_.size() - 1);
}

double SpeedProfile::arc_m(double time_s) const {
  const double at = std::clamp(time_s, 0.0, duration_s()) / kStep_s;
  const auto i = std::min(static_cast<std::size_t>(at), arc_m_.size() - 2);
  const double t = at - static_cast<double>(i), u = 1.0 - t;
  return u * u * ((1.0 + 2.0 * t) * arc_m_[i] + t * kStep_s * speed_m_s_[i]) +
         t * t * ((3.0 - 2.0 * t) * arc_m_[i + 1] - u * kStep_s * speed_m_s_[i + 1]);
}

double SpeedProfile::speed_m_s(double time_s) const {
  const double at = std::clamp(time_s, 0.0, duration_s()) / kStep_s;
  const auto i = std::min(static_cast<std::size_t>(at), arc_m_.size() - 2);
  const double t = at - static_cast<double>(i);
  return (1.0 - t) * speed_m_s_[i] + t * speed_m_s_[i + 1];
}

double SpeedProfile::timeOf(double arc_m) const {
  const auto after = std::lower_bound(arc_m_.begin(), arc_m_.end(), arc_m);
  if (after == arc_m_.begin()) return 0.0;
  if (after == arc_m_.end()) return duration_s();
  const auto i = static_cast<std::size_t>(after - arc_m_.begin());
  const double share = (arc_m - arc_m_[i - 1]) / (arc_m_[i] - arc_m_[i - 1]);
  return kStep_s * (static_cast<double>(i - 1) + share);
}

}  // namespace stereo_nav::sim
