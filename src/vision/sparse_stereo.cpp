#include "vision/sparse_stereo.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vision/pixel.h"

namespace stereo_nav::vision {
namespace {

constexpr double kVague_px = 0.5;  ///< of the row: a search from one level further up

}  // namespace

void SparseStereoParams::describe(ParameterVisitor& visitor) {
  visitSection(visitor, "refinement", refinement);
  visitSection(visitor, "epipolar_error", epipolar_error);
  visitor.real("max_disparity_share", max_disparity_share, {0.01, 1.0}, "",
               "largest disparity searched, as a share of the image width");
  visitor.integer("search_window_px", search_window_px, {3, Patch::kMaxWindow}, "px",
                  "side of the patch compared on the coarse level; odd");
  visitor.real("search_correlation", search_correlation, {-1.0, 1.0}, "",
               "normalised correlation that the coarse match must reach");
  visitor.real("uniqueness", uniqueness, {0.0, 1.0}, "",
               "a second place with more than this share of the best correlation makes a match ambiguous");
  visitor.real("max_epipolar_px", max_epipolar_px, {0.1, 50.0}, "px",
               "distance from the epipolar line at most");
  visitor.real("min_disparity_px", min_disparity_px, {1e-3, 10.0}, "px",
               "points with less are too far to have a depth");
}

SparseStereoMatcher::SparseStereoMatcher(const SparseStereoParams& params,
                                         const StereoCalibration& calibration)
    : params_(params),
      calibration_(calibration),
      tracker_(params.refinement),
      epipolar_error_(params.epipolar_error, calibration),
      search_level_(calibration.width >= 600 ? 2 : 1) {}

std::optional<StereoMatch> SparseStereoMatcher::accept(const Eigen::Isometry3d& T_late_camera,
                                                       const Eigen::Vector2d& left_px,
                                                       const Eigen::Vector2d& right_px,
                                                       double slack_px) const {
  const Eigen::Vector2d straight_px = right_px - epipolar_error_.at(right_px);
  const Triangulation depth = triangulate(calibration_, T_late_camera, left_px, straight_px);
  if (!(std::abs(depth.epipolar_px) <= params_.max_epipolar_px + slack_px + epipolar_error_.slack_px()))
    return std::nullopt;
  const double least = params_.min_disparity_px / (calibration_.fx * calibration_.baseline_m);
  if (!(depth.inverse_depth >= least)) return std::nullopt;
  return StereoMatch{straight_px, depth};
}

std::optional<StereoMatch> SparseStereoMatcher::align(const ImagePyramid& left, const ImagePyramid& right,
                                                      const Eigen::Isometry3d& T_late_camera,
                                                      const Eigen::Vector2d& left_px,
                                                      const Eigen::Vector2d& start_px,
                                                      double slack_px) const {
  const bool is_vague = slack_px + epipolar_error_.slack_px() > kVague_px;
  const auto match = tracker_.track(left, toCv(left_px), right, toCv(start_px), is_vague ? 2 : 1);
  if (!match) return std::nullopt;
  return accept(T_late_camera, left_px, toEigen(match->px), slack_px);
}

std::optional<StereoMatch> SparseStereoMatcher::refine(const ImagePyramid& left, const ImagePyramid& right,
                                                       const Eigen::Isometry3d& T_late_camera,
                                                       const Eigen::Vector2d& left_px,
                                                       const Eigen::Vector2d& guess_px,
                                                       double slack_px) const {
  if (!guess_px.allFinite()) return std::nullopt;
  return align(left, right, T_late_camera, left_px, withRowError(guess_px), slack_px);
}

std::optional<StereoMatch> SparseStereoMatcher::search(const ImagePyramid& left, const ImagePyramid& right,
                                                       const Eigen::Isometry3d& T_late_camera,
                                                       const Eigen::Vector2d& left_px,
                                                       double slack_px) const {
  const double tolerance_px = params_.max_epipolar_px + slack_px + epipolar_error_.slack_px();
  const int level = std::min({search_level_, left.levels() - 1, right.levels() - 1});
  const float scale = 1.0F / static_cast<float>(1 << level);
  const auto patch = Patch::cut(left.level(level), toCv(left_px) * scale, params_.search_window_px, 0.0);
  if (!patch) return std::nullopt;
  const cv::Mat& image = right.level(level);
  // Fast rigs whose cameras are far apart in time make it large: no more rows than there are.
  const auto row_tolerance =
      static_cast<int>(std::min<double>(image.rows, tolerance_px / static_cast<double>(1 << level)));
  const int steps = static_cast<int>(params_.max_disparity_share * image.cols);
  const double inverse_depth_step = (1 << level) / (calibration_.fx * calibration_.baseline_m);

  std::vector<float> likeness(static_cast<std::size_t>(steps) + 1, -1.0F);
  std::vector<cv::Point2f> places(likeness.size());
  std::size_t best = 0;
  for (std::size_t s = 0; s < likeness.size(); ++s) {
    const Eigen::Vector2d expected_px =
        transferToRight(calibration_, T_late_camera, left_px, static_cast<double>(s) * inverse_depth_step);
    const cv::Point2f px = toCv(withRowError(expected_px)) * scale;
    const auto x = static_cast<int>(std::lround(px.x));
    for (int dy = -row_tolerance; dy <= row_tolerance; ++dy) {
      const auto y = static_cast<int>(std::lround(px.y)) + dy;
      if (!(px.x >= 2.0F) || x >= image.cols - 2 || y < 2 || y >= image.rows - 2) continue;
      const float value = patch->correlation(image, x, y);
      if (value <= likeness[s]) continue;
      likeness[s] = value;
      places[s] = {static_cast<float>(x), static_cast<float>(y)};
    }
    if (likeness[s] > likeness[best]) best = s;
  }
  if (likeness[best] < static_cast<float>(params_.search_correlation)) return std::nullopt;
  constexpr std::size_t kPeakWidth = 3;
  for (std::size_t s = 1; s + 1 < likeness.size(); ++s) {
    const bool peak = likeness[s] >= likeness[s - 1] && likeness[s] >= likeness[s + 1];
    const bool apart = s + kPeakWidth < best || s > best + kPeakWidth;
    if (peak && apart && likeness[s] > static_cast<float>(params_.uniqueness) * likeness[best])
      return std::nullopt;
  }
  return align(left, right, T_late_camera, left_px, toEigen(places[best] / scale), slack_px);
}

}  // namespace stereo_nav::vision
