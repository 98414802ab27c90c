#include "mapping/mono/patch_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "mapping/mono/inverse_depth.h"
#include "vision/image_pyramid.h"
#include "vision/patch.h"

namespace stereo_nav::mapping {
namespace {

constexpr double kSigmas = 3.0;
/// Landmarks farther than this from their first view count as being there, 1/m.
constexpr double kLeastRho = 1e-3;
/// A patch that shrinks or grows by more looks otherwise.
constexpr float kMostStretch = 2.5F;

/// The landmark in the axes of its first view.
Eigen::Vector3d pointInView(const FirstView& view, const StateBlock& landmark) {
  Vector6d value = landmark.value;
  if (landmark.form == StateBlock::Form::kInverseDepth) {
    value(5) = std::max(value(5), kLeastRho);
    value.head<3>() = pointOf(value);
  }
  return view.T_world_camera.inverse() * Eigen::Vector3d(value.head<3>());
}

}  // namespace

std::shared_ptr<const FirstView> keepView(const cv::Mat& image, const Eigen::Vector2d& px,
                                          const Eigen::Isometry3d& T_world_camera) {
  constexpr int kInner_px = 8;  // beyond it Patch reads the border
  constexpr int kReach_px = kInner_px + vision::ImagePyramid::kBorder_px;
  auto view = std::make_shared<FirstView>();
  const cv::Point nearest(static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y())));
  cv::Mat all;
  // The pyramid's own border is read where the pixel lies near the edge.
  cv::copyMakeBorder(
      image(cv::Rect(nearest.x - kReach_px, nearest.y - kReach_px, 2 * kReach_px + 1, 2 * kReach_px + 1) &
            cv::Rect(0, 0, image.cols, image.rows)),
      all, std::max(0, kReach_px - nearest.y), std::max(0, nearest.y + kReach_px - image.rows + 1),
      std::max(0, kReach_px - nearest.x), std::max(0, nearest.x + kReach_px - image.cols + 1),
      cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED);
  constexpr int kBorder = vision::ImagePyramid::kBorder_px;
  view->surroundings = all(cv::Rect(kBorder, kBorder, 2 * kInner_px + 1, 2 * kInner_px + 1));
  view->centre = cv::Point2f(static_cast<float>(kInner_px + px.x() - nearest.x),
                             static_cast<float>(kInner_px + px.y() - nearest.y));
  view->px = px;
  view->T_world_camera = T_world_camera;
  return view;
}

std::optional<Eigen::Matrix2f> warpOf(const MonoCamera& camera, const FirstView& view,
                                      const StateBlock& landmark, const CameraState& now,
                                      const Eigen::Vector2d& expected_px) {
  const Eigen::Vector3d p_view = pointInView(view, landmark);
  const Eigen::Vector3d normal = p_view.normalized();
  const Eigen::Isometry3d T_view_now = view.T_world_camera.inverse() * now.T_world_camera();
  const auto inView = [&](const Eigen::Vector2d& px) -> std::optional<Eigen::Vector2d> {
    const Eigen::Vector3d ray = T_view_now.linear() * camera.ray(px);
    const double distance = normal.dot(p_view - T_view_now.translation()) / normal.dot(ray);
    if (!(distance > 0.0)) return std::nullopt;
    const auto projected = camera.project(T_view_now.translation() + distance * ray);
    if (!projected) return std::nullopt;
    return projected->px;
  };
  constexpr double kStep_px = 3.0;
  Eigen::Matrix2d warp;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d step = kStep_px * Eigen::Vector2d::Unit(axis);
    const auto after = inView(expected_px + step);
    const auto before = inView(expected_px - step);
    if (!after || !before) return std::nullopt;
    warp.col(axis) = (*after - *before) / (2.0 * kStep_px);
  }
  const double stretch = std::sqrt(std::abs(warp.determinant()));
  if (!(stretch < kMostStretch && stretch > 1.0 / kMostStretch)) return std::nullopt;
  return warp.cast<float>();
}

std::optional<Eigen::Vector2d> searchPatch(const cv::Mat& image, const FirstView& view,
                                           const Eigen::Matrix2f& warp, const Eigen::Vector2d& expected_px,
                                           const Eigen::Matrix2d& covariance,
                                           const PatchSearchParams& params) {
  const auto patch =
      vision::Patch::cut(view.surroundings, view.centre, params.window_px, params.min_texture, warp);
  if (!patch) return std::nullopt;
  const Eigen::Matrix2d information = covariance.inverse();
  const auto halfAxis = [&](int axis) {
    return std::min(params.most_search_px, kSigmas * std::sqrt(covariance(axis, axis)));
  };
  const int margin = 2;
  const int left = std::max(margin, static_cast<int>(std::ceil(expected_px.x() - halfAxis(0))));
  const int right = std::min(image.cols - 1 - margin, static_cast<int>(expected_px.x() + halfAxis(0)));
  const int top = std::max(margin, static_cast<int>(std::ceil(expected_px.y() - halfAxis(1))));
  const int bottom = std::min(image.rows - 1 - margin, static_cast<int>(expected_px.y() + halfAxis(1)));
  float best = static_cast<float>(params.min_correlation);
  std::optional<Eigen::Vector2d> found;
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const Eigen::Vector2d way = Eigen::Vector2d(x, y) - expected_px;
      if (way.dot(information * way) > kSigmas * kSigmas) continue;
      const float correlation = patch->correlation(image, x, y);
      if (correlation < best) continue;
      best = correlation;
      found = Eigen::Vector2d(x, y);
    }
  }
  if (!found) return std::nullopt;
  constexpr int kIterations = 10;
  constexpr double kLeastStep_px = 0.01;
  const cv::Point2f whole(static_cast<float>(found->x()), static_cast<float>(found->y()));
  const auto match = patch->align(image, whole, kIterations, kLeastStep_px);
  // A peak between pixels is at most a pixel away along each axis.
  if (match && match->converged && cv::norm(match->px - whole) < 1.5)
    return Eigen::Vector2d(match->px.x, match->px.y);
  return found;
}

}  // namespace stereo_nav::mapping
