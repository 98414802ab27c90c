#include "vision/grid_corner_detector.h"

#include <algorithm>
#include <cmath>
#include <opencv2/features2d.hpp>

namespace stereo_nav::vision {
namespace {

constexpr int kFastRadius_px = 3;
constexpr int kEdge_px = 8;         ///< corners nearer to the edge have half a patch only
constexpr int kPerCell = 3;         ///< candidates kept per cell, for the cells that fill in for empty ones
constexpr int kPlentyPerCell = 12;  ///< more than this: the threshold may rise

/// Which pixels are too near to a corner already taken: a bucket grid of the distance's size.
class Neighbourhood {
 public:
  Neighbourhood(const cv::Size& size, double distance_px)
      : distance_px_(static_cast<float>(distance_px)),
        columns_(static_cast<int>(static_cast<float>(size.width) / distance_px_) + 1),
        rows_(static_cast<int>(static_cast<float>(size.height) / distance_px_) + 1),
        buckets_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  void add(const cv::Point2f& px) { buckets_[index(column(px), row(px))].push_back(px); }

  bool contains(const cv::Point2f& px) const {
    for (int r = std::max(0, row(px) - 1); r <= std::min(rows_ - 1, row(px) + 1); ++r) {
      for (int c = std::max(0, column(px) - 1); c <= std::min(columns_ - 1, column(px) + 1); ++c) {
        for (const cv::Point2f& other : buckets_[index(c, r)]) {
          if (std::hypot(other.x - px.x, other.y - px.y) < distance_px_) return true;
        }
      }
    }
    return false;
  }

 private:
  int column(const cv::Point2f& px) const {
    return std::clamp(static_cast<int>(px.x / distance_px_), 0, columns_ - 1);
  }
  int row(const cv::Point2f& px) const {
    return std::clamp(static_cast<int>(px.y / distance_px_), 0, rows_ - 1);
  }
  std::size_t index(int c, int r) const {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c);
  }

  float distance_px_;
  int columns_;
  int rows_;
  std::vector<std::vector<cv::Point2f>> buckets_;
};

}  // namespace

void GridCornerDetectorParams::describe(ParameterVisitor& visitor) {
  visitor.integer("features", features, {10, 5000}, "", "live tracks wanted");
  visitor.integer("cells", cells, {1, 5000}, "", "square cells that the image is cut into, about");
  visitor.integer("initial_threshold", initial_threshold, {1, 255}, "grey levels",
                  "FAST threshold of every cell at the start");
  visitor.integer("min_threshold", min_threshold, {1, 255}, "grey levels",
                  "FAST threshold that an empty cell goes down to");
  visitor.real("min_distance_px", min_distance_px, {1.0, 1000.0}, "px", "least distance between two corners");
}

GridCornerDetector::GridCornerDetector(const GridCornerDetectorParams& params, const cv::Size& image_size)
    : params_(params), image_size_(image_size) {
  cell_size_px_ =
      std::max(2 * kFastRadius_px + 4,
               static_cast<int>(std::sqrt(static_cast<double>(image_size.area()) / params.cells)));
  columns_ = std::max(1, image_size.width / cell_size_px_);
  rows_ = std::max(1, image_size.height / cell_size_px_);
  reset();
}

void GridCornerDetector::reset() {
  thresholds_.assign(static_cast<std::size_t>(columns_ * rows_), params_.initial_threshold);
}

cv::Rect GridCornerDetector::cellRect(int cell) const {
  const int column = cell % columns_;
  const int row = cell / columns_;
  const int left = column * image_size_.width / columns_;
  const int top = row * image_size_.height / rows_;
  const int right = (column + 1) * image_size_.width / columns_;
  const int bottom = (row + 1) * image_size_.height / rows_;
  // FAST leaves out a rim of its radius; cells overlap by it so that no corner is lost between them.
  const cv::Rect wide(left - kFastRadius_px, top - kFastRadius_px, right - left + 2 * kFastRadius_px,
                      bottom - top + 2 * kFastRadius_px);
  return wide & cv::Rect(kEdge_px - kFastRadius_px, kEdge_px - kFastRadius_px,
                         image_size_.width - 2 * (kEdge_px - kFastRadius_px),
                         image_size_.height - 2 * (kEdge_px - kFastRadius_px));
}

void GridCornerDetector::detectCell(const cv::Mat& image, int cell, int occupied,
                                    std::vector<Candidate>& candidates) {
  const cv::Rect rect = cellRect(cell);
  int& threshold = thresholds_[static_cast<std::size_t>(cell)];
  std::vector<cv::KeyPoint> corners;
  cv::FAST(image(rect), corners, threshold, true);
  while (corners.empty() && threshold > params_.min_threshold) {
    threshold = std::max(params_.min_threshold, threshold / 2);
    cv::FAST(image(rect), corners, threshold, true);
  }
  if (corners.size() > kPlentyPerCell) threshold = std::min(255, threshold + threshold / 4 + 1);
  const auto kept = std::min<std::size_t>(kPerCell, corners.size());
  std::partial_sort(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(kept), corners.end(),
                    [](const cv::KeyPoint& a, const cv::KeyPoint& b) {
                      if (a.response != b.response) return a.response > b.response;
                      return a.pt.y != b.pt.y ? a.pt.y < b.pt.y : a.pt.x < b.pt.x;
                    });
  for (std::size_t i = 0; i < kept; ++i) {
    const cv::Point2f px =
        corners[i].pt + cv::Point2f(static_cast<float>(rect.x), static_cast<float>(rect.y));
    candidates.push_back({px, corners[i].response, occupied + static_cast<int>(i)});
  }
}

std::vector<cv::Point2f> GridCornerDetector::detect(const cv::Mat& image,
                                                    const std::vector<cv::Point2f>& occupied) {
  std::vector<cv::Point2f> found;
  int wanted = params_.features - static_cast<int>(occupied.size());
  if (wanted <= 0) return found;
  std::vector<int> population(thresholds_.size(), 0);
  Neighbourhood taken(image_size_, params_.min_distance_px);
  for (const cv::Point2f& px : occupied) {
    const int column = std::clamp(static_cast<int>(px.x) * columns_ / image_size_.width, 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>(px.y) * rows_ / image_size_.height, 0, rows_ - 1);
    ++population[static_cast<std::size_t>(row * columns_ + column)];
    taken.add(px);
  }
  // Empty cells first; the fuller ones are looked at only when those do not suffice.
  std::vector<Candidate> candidates;
  for (int rank = 0; rank < kPerCell && wanted > 0; ++rank) {
    for (std::size_t cell = 0; cell < population.size(); ++cell) {
      if (population[cell] == rank) detectCell(image, static_cast<int>(cell), rank, candidates);
    }
    std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
      return a.rank != b.rank ? a.rank < b.rank : a.response > b.response;
    });
    auto next = candidates.begin();
    for (; next != candidates.end() && next->rank == rank && wanted > 0; ++next) {
      if (taken.contains(next->px)) continue;
      taken.add(next->px);
      found.push_back(next->px);
      --wanted;
    }
    candidates.erase(candidates.begin(), next);
  }
  return found;
}

}  // namespace stereo_nav::vision
