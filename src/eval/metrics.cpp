#include "eval/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/angles.h"

namespace stereo_nav::eval {
namespace {

constexpr double kStepOff_m = 0.3;
constexpr double kStepOff_deg = 10.0;

/// What the estimate's motion from i to j lacks of the true one.
Eigen::Isometry3d motionError(const Poses& ground_truth, const Poses& estimate, std::size_t i,
                              std::size_t j) {
  return (estimate[i].inverse() * estimate[j]).inverse() * (ground_truth[i].inverse() * ground_truth[j]);
}

}  // namespace

std::vector<double> wayTo(const Poses& poses) {
  std::vector<double> way_m(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i)
    way_m[i] = way_m[i - 1] + (poses[i].translation() - poses[i - 1].translation()).norm();
  return way_m;
}

double rmse(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  if (a.empty() || a.size() != b.size()) {
    throw std::invalid_argument("rmse() needs two lists of equal, nonzero length");
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

std::vector<double> segmentLengths(double path_length_m) {
  std::vector<double> lengths_m;
  for (const double length_m : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0}) {
    if (length_m >= path_length_m / 12.0 && length_m <= path_length_m / 2.0) lengths_m.push_back(length_m);
  }
  return lengths_m;
}

RelativeError relativeError(const Poses& ground_truth, const Poses& estimate,
                            const std::vector<double>& lengths_m) {
  if (ground_truth.size() != estimate.size()) {
    throw std::invalid_argument("relativeError() needs two lists of equal length");
  }
  const auto path_m = wayTo(ground_truth);
  double translation = 0.0;
  double rotation_deg_per_m = 0.0;
  std::size_t count = 0;
  for (const double length_m : lengths_m) {
    for (std::size_t i = 0; i < path_m.size(); ++i) {
      const auto reached = std::find_if(path_m.begin() + static_cast<std::ptrdiff_t>(i), path_m.end(),
                                        [&](double to_m) { return to_m - path_m[i] >= length_m; });
      if (reached == path_m.end()) break;
      const auto j = static_cast<std::size_t>(reached - path_m.begin());
      const Eigen::Isometry3d error = motionError(ground_truth, estimate, i, j);
      translation += error.translation().norm() / length_m;
      rotation_deg_per_m += angleDeg(error.linear()) / length_m;
      ++count;
    }
  }
  const double n = count == 0 ? std::numeric_limits<double>::quiet_NaN() : static_cast<double>(count);
  return {100.0 * translation / n, rotation_deg_per_m / n, lengths_m};
}

SegmentErrors segmentErrors(const Poses& ground_truth, const Poses& estimate,
                            const std::vector<double>& way_m, double length_m) {
  SegmentErrors errors;
  errors.length_m = length_m;
  double translation_m = 0.0, rotation_deg = 0.0;
  std::size_t j = 0;
  for (std::size_t i = 0; i < way_m.size(); ++i) {
    while (j < way_m.size() && way_m[j] - way_m[i] < length_m) ++j;
    if (j == way_m.size()) break;
    const Eigen::Isometry3d error = motionError(ground_truth, estimate, i, j);
    translation_m += error.translation().norm();
    rotation_deg += angleDeg(error.linear());
    ++errors.pairs;
  }
  if (errors.pairs == 0) return errors;
  const double total_m = length_m * static_cast<double>(errors.pairs);
  errors.translation_percent = 100.0 * translation_m / total_m;
  errors.rotation_deg_per_m = rotation_deg / total_m;
  return errors;
}

std::size_t stepsOff(const Poses& ground_truth, const Poses& estimate) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < estimate.size(); ++i) {
    const Eigen::Isometry3d error = motionError(ground_truth, estimate, i - 1, i);
    if (error.translation().norm() > kStepOff_m || angleDeg(error.linear()) > kStepOff_deg) ++count;
  }
  return count;
}

double angleDeg(const Eigen::Matrix3d& R) {
  return Eigen::AngleAxisd(R).angle() * kDegPerRad;  // goes over atan2, unlike acos of the trace
}

}  // namespace stereo_nav::eval
