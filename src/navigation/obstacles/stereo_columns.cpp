#include "navigation/obstacles/stereo_columns.h"

#include <algorithm>
#include <cmath>

#include "core/angles.h"

namespace stereo_nav::navigation {
namespace {

constexpr int kBinsPerPixel = 2;
constexpr int kMostDisparities = 512;
constexpr double kSure = 3.0;           // deviations
constexpr double kShareOfLowest = 0.5;  // of the pixels that the lowest obstacle shows
constexpr int kFewestRows = 3;
constexpr int kFewestHoleRows = 4;

}  // namespace

const std::vector<ColumnView>& StereoColumns::look(const cv::Mat& disparity, const DisparityCamera& camera) {
  floor_ = estimatedFloor(disparity, camera, floorOf(camera), params_.max_tilt_deg * kRadPerDeg);
  counts_.resize(kBinsPerPixel * kMostDisparities);
  sums_.resize(counts_.size());
  const int columns = disparity.cols / params_.column_px;
  views_.resize(static_cast<std::size_t>(columns));
  for (int i = 0; i < columns; ++i)
    lookAt(disparity, camera, i * params_.column_px, (i + 1) * params_.column_px,
           views_[static_cast<std::size_t>(i)]);
  return views_;
}

void StereoColumns::lookAt(const cv::Mat& disparity, const DisparityCamera& camera, int first, int last,
                           ColumnView& view) {
  view.u = 0.5 * (first + last - 1);
  view.obstacles_m.clear();
  view.holes_m.clear();
  std::fill(counts_.begin(), counts_.end(), 0);
  std::fill(sums_.begin(), sums_.end(), 0.0);
  const double fb = camera.fx * camera.baseline_m;
  const double d_far = fb / params_.range_max_m;
  double nearest_floor_d = 0.0, farthest_floor_d = 1e9;
  int floor_rows = 0;
  for (int v = 0; v < disparity.rows; ++v) {
    const float* row = disparity.ptr<float>(v);
    for (int u = first; u < last; ++u) {
      const double d = row[u];
      if (d <= 0.0) continue;
      const double d_floor = floor_.disparity(u, v);
      const double height_m = floor_.height_m * (1.0 - d_floor / d);
      const double sigma_m = floor_.height_m * std::fabs(d_floor) / (d * d) * params_.disparity_sigma_px;
      if (height_m > params_.min_height_m + sigma_m && height_m < params_.max_height_m) {
        const auto bin = static_cast<std::size_t>(d * kBinsPerPixel);
        if (d < d_far || bin >= counts_.size()) continue;
        ++counts_[bin];
        sums_[bin] += d;
      } else if (std::fabs(height_m) < params_.min_height_m + kSure * sigma_m && d_floor > d_far) {
        nearest_floor_d = std::max(nearest_floor_d, d_floor);
        farthest_floor_d = std::min(farthest_floor_d, d_floor);
        ++floor_rows;
      }
    }
  }
  findObstacles(camera, last - first, view);
  findHoles(disparity, camera, (first + last) / 2, view);
  const bool sees_floor = floor_rows >= kFewestRows * (last - first);
  view.clear_from_m = sees_floor ? fb / nearest_floor_d : 0.0;
  view.clear_to_m = sees_floor ? fb / farthest_floor_d : 0.0;
  for (const auto* ends : {&view.obstacles_m, &view.holes_m})
    if (!ends->empty())
      view.clear_to_m = std::min(view.clear_to_m, *std::min_element(ends->begin(), ends->end()));
}

/// Neighbouring bins that hold pixels are one surface. From near to far.
void StereoColumns::findObstacles(const DisparityCamera& camera, int columns, ColumnView& view) {
  const double fb = camera.fx * camera.baseline_m;
  int count = 0;
  double sum = 0.0;
  for (std::size_t bin = counts_.size(); bin-- > 0;) {
    count += counts_[bin];
    sum += sums_[bin];
    if (count == 0 || (counts_[bin] > 0 && bin > 0)) continue;
    const double d = sum / count;
    const double rows_of_lowest = camera.fy * params_.min_height_m * d / fb;
    if (count >= columns * std::max<double>(kFewestRows, kShareOfLowest * rows_of_lowest))
      view.obstacles_m.push_back(fb / d);
    count = 0;
    sum = 0.0;
  }
}

/// From the bottom of the image upwards, that is, away from the robot.
void StereoColumns::findHoles(const cv::Mat& disparity, const DisparityCamera& camera, int column,
                              ColumnView& view) const {
  const double fb = camera.fx * camera.baseline_m;
  double first_d = 0.0, last_d = 0.0;  // floor disparities of the rows that are too deep
  int deep_rows = 0;
  for (int v = disparity.rows - 1; v >= 0; --v) {
    const double d = disparity.at<float>(v, column), d_floor = floor_.disparity(column, v);
    if (d_floor < fb / params_.range_max_m) return;
    if (d <= 0.0) continue;
    const double height_m = floor_.height_m * (1.0 - d_floor / d);
    const double sigma_m = floor_.height_m * d_floor / (d * d) * params_.disparity_sigma_px;
    if (height_m < -params_.hole_depth_m - kSure * sigma_m) {
      if (deep_rows++ == 0) first_d = d_floor;
      last_d = d_floor;
      continue;
    }
    const bool floor_goes_on = height_m < params_.min_height_m + sigma_m;
    if (deep_rows >= kFewestHoleRows && floor_goes_on) {
      view.holes_m.push_back(fb / first_d);
      view.holes_m.push_back(fb / last_d);
    }
    deep_rows = 0;
  }
}

}  // namespace stereo_nav::navigation
