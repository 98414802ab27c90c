#include "vision/camera_order.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

namespace stereo_nav::vision {
namespace {

constexpr int kReducedWidth = 320;  // px: enough texture is left, and the search stays cheap
constexpr int kPatchRadius = 5;     // px of the reduced image, as all below
constexpr int kSearchRows = 4;
constexpr int kMinDisparity = 2;
constexpr int kCorners = 40;
constexpr double kMinScore = 0.9;    // normalised correlation of a match
constexpr double kMinMargin = 0.08;  // lead over the best match elsewhere
constexpr std::size_t kObservations = 5;
constexpr int kMinVotes = 30;
constexpr double kMajority = 0.75;

/// x_left - x_right of a corner, if exactly one place in the right image looks like it.
std::optional<int> matchBothSides(const cv::Mat& left, const cv::Mat& right, const cv::Point& corner) {
  const cv::Rect image(0, 0, left.cols, left.rows);
  const int patch_size = 2 * kPatchRadius + 1;
  const cv::Rect patch(corner.x - kPatchRadius, corner.y - kPatchRadius, patch_size, patch_size);
  const int reach = left.cols / 4;
  const cv::Rect search = cv::Rect(patch.x - reach, patch.y - kSearchRows, patch.width + 2 * reach,
                                   patch.height + 2 * kSearchRows) &
                          image;
  if ((patch & image) != patch || search.height < patch.height || search.width < patch.width)
    return std::nullopt;

  cv::Mat score;
  cv::matchTemplate(right(search), left(patch), score, cv::TM_CCOEFF_NORMED);
  double best = 0.0;
  cv::Point best_at;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &best_at);
  if (!(best > kMinScore)) return std::nullopt;
  const int disparity = patch.x - (search.x + best_at.x);

  constexpr int kPeakRadius = 3;
  score(cv::Rect(best_at.x - kPeakRadius, 0, 2 * kPeakRadius + 1, score.rows) &
        cv::Rect(0, 0, score.cols, score.rows)) = -1.0;
  double second = 0.0;
  cv::minMaxLoc(score, nullptr, &second);
  if (best - second < kMinMargin) return std::nullopt;
  return disparity;
}

cv::Mat reduce(const cv::Mat& image, int factor) {
  if (factor == 1) return image;
  cv::Mat reduced;
  cv::resize(image, reduced, cv::Size(image.cols / factor, image.rows / factor), 0.0, 0.0, cv::INTER_AREA);
  return reduced;
}

}  // namespace

void CameraOrderCheck::observe(const cv::Mat& left, const cv::Mat& right) {
  const int factor = std::max(1, (left.cols + kReducedWidth - 1) / kReducedWidth);
  const cv::Mat left_reduced = reduce(left, factor);
  const cv::Mat right_reduced = reduce(right, factor);
  constexpr double kQuality = 0.02;
  constexpr double kSpacing = 8.0;
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(left_reduced, corners, kCorners, kQuality, kSpacing);

  const double offset = (calibration_.cx - calibration_.right_cx) / factor;
  Votes votes;
  for (const cv::Point2f& corner : corners) {
    const auto match = matchBothSides(left_reduced, right_reduced, cv::Point(corner));
    if (!match) continue;
    const double disparity = *match - offset;
    if (disparity >= kMinDisparity) ++votes.positive;
    if (disparity <= -kMinDisparity) ++votes.negative;
  }
  votes_.push_back(votes);
  if (votes_.size() > kObservations) votes_.pop_front();
}

CameraOrderCheck::Verdict CameraOrderCheck::verdict() const {
  Votes sum;
  for (const Votes& votes : votes_) {
    sum.positive += votes.positive;
    sum.negative += votes.negative;
  }
  const int total = sum.positive + sum.negative;
  if (total < kMinVotes) return Verdict::kUnknown;
  if (sum.negative > kMajority * total) return Verdict::kSwapped;
  return sum.positive > kMajority * total ? Verdict::kInOrder : Verdict::kUnknown;
}

}  // namespace stereo_nav::vision
