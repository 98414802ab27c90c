#include "vision/patch_tracker.h"

#include <algorithm>

namespace stereo_nav::vision {
namespace {

constexpr double kCoarseTexture = 0.25;  ///< only to keep the equations solvable

}  // namespace

void PatchTrackerParams::describe(ParameterVisitor& visitor) {
  visitor.integer("window_px", window_px, {5, Patch::kMaxWindow}, "px",
                  "side of the patch on the finest level; odd");
  visitor.integer("coarse_window_px", coarse_window_px, {5, Patch::kMaxWindow}, "px",
                  "side of the patch on the coarse levels; odd");
  visitor.integer("iterations", iterations, {1, 100}, "", "most steps per level");
  visitor.real("min_step_px", min_step_px, {1e-4, 1.0}, "px", "a shorter step ends the search on a level");
  visitor.real("min_texture", min_texture, {0.0, 1000.0}, "grey levels^2/px^2",
               "smaller eigenvalue of the mean gradient moments that a patch must have");
  visitor.real("min_correlation", min_correlation, {-1.0, 1.0}, "",
               "normalised correlation that a match must reach");
}

std::optional<Patch::Match> PatchTracker::track(const ImagePyramid& from, const cv::Point2f& px,
                                                const ImagePyramid& to, const cv::Point2f& guess,
                                                int top_level, const Eigen::Matrix2f& step,
                                                int finest_level) const {
  cv::Point2f position = guess;
  const int top = std::min({top_level, from.levels() - 1, to.levels() - 1});
  for (int l = top; l >= finest_level; --l) {
    const float scale = 1.0F / static_cast<float>(1 << l);
    // The coarse levels of a weakly textured patch may still help: only the finest one asks for texture.
    const auto patch =
        Patch::cut(from.level(l), px * scale, l == 0 ? params_.window_px : params_.coarse_window_px,
                   l == finest_level ? params_.min_texture : kCoarseTexture, step);
    auto match = patch ? patch->align(to.level(l), position * scale, params_.iterations, params_.min_step_px)
                       : std::nullopt;
    if (match) match->px /= scale;
    if (l > finest_level) {
      if (match) position = match->px;
      continue;
    }
    if (match && match->correlation >= static_cast<float>(params_.min_correlation)) return match;
  }
  return std::nullopt;
}

}  // namespace stereo_nav::vision
