#include "navigation/obstacles/standing_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace stereo_nav::navigation {
namespace {

constexpr int kHalfWidth = 4, kHalfHeight = 3;
constexpr int kSamples = (kHalfWidth + 1) * (2 * kHalfHeight + 1);  // every second column
constexpr int kBorder = kHalfHeight + 3;
constexpr double kLeastContrast = 16.0;  // grey levels over two pixels
constexpr double kLeastStep_px = 0.5, kMostStep_px = 1.0, kRelativeStep = 0.04;
constexpr double kNearest_m = 0.7;
constexpr double kLeastMotion_m = 0.06, kBestMotion_m = 0.3, kKeptEach_m = 0.05;
constexpr double kMostTurn_rad = 0.17;
/// An edge looks the same within this share of the contrast of its patch, and at least so many grey levels.
constexpr double kSame = 0.08, kSameLevels = 1.0;
constexpr double kSharp_m = 0.2;  // an edge without a foot must be known as well as this
constexpr std::size_t kKept = 10;

using Samples = std::array<float, kSamples>;

/// Bilinear samples around a place, `scale` pixels apart, less their mean; false where they leave the image.
bool take(const cv::Mat& image, double x, double y, double scale, Samples& samples) {
  const double reach_x = kHalfWidth * scale + 1.0, reach_y = kHalfHeight * scale + 1.0;
  if (!(x - reach_x >= 0.0 && y - reach_y >= 0.0 && x + reach_x < image.cols - 1 &&
        y + reach_y < image.rows - 1))
    return false;
  float sum = 0.0F;
  std::size_t i = 0;
  for (int dy = -kHalfHeight; dy <= kHalfHeight; ++dy) {
    const double sy = y + dy * scale;
    const int y0 = static_cast<int>(sy);
    const auto fy = static_cast<float>(sy - y0);
    const std::uint8_t *upper = image.ptr(y0), *lower = image.ptr(y0 + 1);
    for (int dx = -kHalfWidth; dx <= kHalfWidth; dx += 2) {
      const double sx = x + dx * scale;
      const int x0 = static_cast<int>(sx);
      const auto fx = static_cast<float>(sx - x0);
      const float a = upper[x0] + fx * (upper[x0 + 1] - upper[x0]);
      const float b = lower[x0] + fx * (lower[x0 + 1] - lower[x0]);
      sum += samples[i++] = a + fy * (b - a);
    }
  }
  for (float& value : samples) value -= sum / kSamples;
  return true;
}

double difference(const Samples& a, const Samples& b) {
  float sum = 0.0F;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::fabs(a[i] - b[i]);
  return static_cast<double>(sum) / kSamples;
}

double contrast(const Samples& a) {
  float sum = 0.0F;
  for (const float value : a) sum += std::fabs(value);
  return static_cast<double>(sum) / kSamples;
}

}  // namespace

const std::vector<StandingEdge>& StandingEdges::look(const RectifiedPair& pair, const cv::Mat& disparity,
                                                     const DisparityCamera& camera, const FloorPlane& floor,
                                                     const Eigen::Isometry3d& T_odom_camera) {
  edges_.clear();
  cv::GaussianBlur(pair.left, left_, {3, 3}, 0.0);
  cv::GaussianBlur(pair.right, right_, {3, 3}, 0.0);
  view_ = partner(T_odom_camera);
  if (view_ != nullptr) T_earlier_now_ = view_->T_odom_camera.inverse() * T_odom_camera;
  // No farther apart than the cells are at the end of the range.
  const int step = std::max(1, static_cast<int>(camera.fx * params_.resolution_m / params_.range_max_m));
  for (int u = kBorder; u < left_.cols - kBorder; u += step) lookAt(u, disparity, camera, floor);
  keep(T_odom_camera);
  return edges_;
}

void StandingEdges::keep(const Eigen::Isometry3d& T_odom_camera) {
  if (!earlier_.empty() &&
      (T_odom_camera.translation() - earlier_.back().T_odom_camera.translation()).norm() < kKeptEach_m)
    return;
  View view;
  if (earlier_.size() == kKept) {
    view = std::move(earlier_.front());
    earlier_.pop_front();
  }
  left_.copyTo(view.left);
  view.T_odom_camera = T_odom_camera;
  earlier_.push_back(std::move(view));
}

/// The earlier view that is the right way off and looks in much the same direction.
const StandingEdges::View* StandingEdges::partner(const Eigen::Isometry3d& T_odom_camera) const {
  const View* best = nullptr;
  double best_off_m = std::numeric_limits<double>::infinity();
  for (const View& view : earlier_) {
    const Eigen::Isometry3d moved = view.T_odom_camera.inverse() * T_odom_camera;
    const double moved_m = moved.translation().norm();
    if (moved_m < kLeastMotion_m || Eigen::AngleAxisd(moved.linear()).angle() > kMostTurn_rad ||
        view.left.size() != left_.size())
      continue;
    const double off_m = std::fabs(moved_m - kBestMotion_m);
    if (off_m > best_off_m) continue;
    best = &view;
    best_off_m = off_m;
  }
  return best;
}

/// How much brightness changes down the image, over two rows.
double StandingEdges::gradient(int u, int v) const {
  const std::uint8_t *upper = left_.ptr(v - 1), *lower = left_.ptr(v + 1);
  int sum = 0;
  for (int du = -2; du <= 2; du += 2) sum += lower[u + du] - upper[u + du];
  return std::abs(sum) / 3.0;
}

void StandingEdges::findRows(int u) {
  rows_.clear();
  for (int v = left_.rows - kBorder; v > kBorder; --v) {
    const double here = gradient(u, v);
    if (here >= kLeastContrast && here >= gradient(u, v - 1) && here > gradient(u, v + 1) &&
        here >= gradient(u, v - 2) && here > gradient(u, v + 2))
      rows_.push_back(v);
  }
}

void StandingEdges::lookAt(int u, const cv::Mat& disparity, const DisparityCamera& camera,
                           const FloorPlane& floor) {
  findRows(u);
  const double fb = camera.fx * camera.baseline_m;
  for (const int v : rows_) {
    const double d_floor = floor.disparity(u, v);
    const auto height_m = [&](double d) { return floor.height_m * (1.0 - d_floor / d); };
    // What lies deeper than the floor, as the background does in a window that has the edge in it, is no
    // answer.
    const double known = disparity.at<float>(v, u);
    if (known > 0.0 && height_m(known) > -params_.min_height_m) continue;
    Span span;
    if (!sweep(u, v, camera, d_floor, span)) continue;
    if (height_m(span.least) < params_.min_height_m || height_m(span.most) > params_.max_height_m ||
        fb / span.most > params_.range_max_m)
      continue;
    double d = footDisparity(u, v, floor, span);
    if (d <= 0.0) {
      if (fb / span.least - fb / span.most > kSharp_m) continue;
      d = 0.5 * (span.least + span.most);
    }
    edges_.push_back({static_cast<double>(u), fb / d});
  }
}

/// The strongest edge below that would be on the floor at such a disparity; 0 if there is none.
double StandingEdges::footDisparity(int u, int v, const FloorPlane& floor, const Span& span) const {
  double d = 0.0, strongest = 0.0;
  for (const int foot : rows_) {
    if (foot <= v) break;
    const double d_foot = floor.disparity(u, foot);
    if (d_foot < span.least || d_foot > span.most || gradient(u, foot) <= strongest) continue;
    strongest = gradient(u, foot);
    d = d_foot;
  }
  return d;
}

/// The span of disparities at which the edge looks the same. False if the floor is among them, or if they do
/// not hang together, or where nothing fits.
bool StandingEdges::sweep(int u, int v, const DisparityCamera& camera, double d_floor, Span& span) {
  Samples here, there;
  if (!take(left_, u, v, 1.0, here)) return false;
  const double fb = camera.fx * camera.baseline_m;
  const double first_d = std::max(1.0, d_floor), last_d = fb / kNearest_m;
  const bool sideways = u - last_d > kBorder;  // else it leaves the right image
  if (!sideways && view_ == nullptr) return false;
  const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1.0);
  const auto cost = [&](double d) {
    double sum = 0.0;
    int terms = 0;
    if (sideways && take(right_, u - d + camera.right_shift_px, v, 1.0, there))
      sum += difference(here, there), ++terms;
    if (view_ != nullptr) {
      const double z_m = fb / d;
      const Eigen::Vector3d p = T_earlier_now_ * Eigen::Vector3d(z_m * ray);
      if (p.z() > 0.0 && take(view_->left, camera.fx * p.x() / p.z() + camera.cx,
                              camera.fy * p.y() / p.z() + camera.cy, z_m / p.z(), there))
        sum += difference(here, there), ++terms;
    }
    return terms == 0 ? std::numeric_limits<double>::infinity() : sum / terms;
  };
  const double strength = contrast(here);
  const double same = std::max(kSameLevels, kSame * strength);
  if (cost(first_d) < same) return false;  // it may lie on the floor
  costs_.clear();
  double least = std::numeric_limits<double>::infinity();
  for (double d = first_d; d <= last_d; d += std::clamp(kRelativeStep * d, kLeastStep_px, kMostStep_px)) {
    costs_.emplace_back(d, cost(d));
    least = std::min(least, costs_.back().second);
  }
  if (!(least < kSameLevels + 0.3 * strength)) return false;
  const auto fits = [&](const auto& entry) { return entry.second <= least + same; };
  const auto first = std::find_if(costs_.begin(), costs_.end(), fits);
  const auto end = std::find_if_not(first, costs_.end(), fits);
  if (first == costs_.begin() || std::any_of(end, costs_.end(), fits)) return false;
  span.least = std::prev(first)->first;
  span.most = end == costs_.end() ? last_d : end->first;
  return true;
}

}  // namespace stereo_nav::navigation
