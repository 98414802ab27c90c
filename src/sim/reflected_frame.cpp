#include "sim/reflected_frame.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stereo_nav::sim {
namespace {

/// What lies in the mirror's plane, such as its frame or a mat on the floor, is not mirrored.
constexpr double kInPlane_m = 0.05;

CameraInstants reflected(const CameraInstants& instants, const Mirror& mirror) {
  CameraInstants result = instants;
  const Eigen::Isometry3d reflection = mirror.reflection();
  for (CameraInstant& instant : result.list) instant.T_world_camera = reflection * instant.T_world_camera;
  return result;
}

/// The room, and what stands on the camera's side of the mirror.
std::vector<const Solid*> inFront(const Scene& scene, const Mirror& mirror, const CameraInstants& instants) {
  const double side = mirror.side(instants.list.front().T_world_camera.translation()) < 0.0 ? -1.0 : 1.0;
  std::vector<const Solid*> solids;
  for (const Solid* solid : scene.solidsAt(instants.list.front().time_s)) {
    const double distance_m = side * mirror.side(solid->position(instants.list.front().time_s));
    if (solid->kind == Solid::Kind::kRoom || distance_m > kInPlane_m) solids.push_back(solid);
  }
  return solids;
}

/// The mirror as a thin box, for the part of the image that it covers.
Solid boxOf(const Mirror& mirror) {
  Solid box;
  box.p_world = mirror.T_world_mirror.translation();
  box.R_solid_world = mirror.T_world_mirror.linear().transpose();
  box.half = {static_cast<float>(mirror.half_x_m), static_cast<float>(mirror.half_y_m), 0.001f};
  return box;
}

}  // namespace

ReflectedFrame::ReflectedFrame(const Scene& scene, const Mirror& mirror, const CameraInstants& instants)
    : mirror_(mirror), mirrored_(inFront(scene, mirror, instants), reflected(instants, mirror)) {
  const Eigen::Isometry3d T_mirror_world = mirror.T_world_mirror.inverse();
  for (const CameraInstant& instant : instants.list) {
    const Eigen::Isometry3d T_mirror_camera = T_mirror_world * instant.T_world_camera;
    views_.push_back({T_mirror_camera.linear().cast<float>(), T_mirror_camera.translation().cast<float>()});
  }
  const Solid box = boxOf(mirror);
  const CameraInstant &first = instants.list.front(), &last = instants.list.back();
  cover_ = RenderedFrame::coverOf(makeCandidate(box, first.T_world_camera, first.time_s),
                                  makeCandidate(box, last.T_world_camera, last.time_s));
}

bool ReflectedFrame::selectVisible(const Renderer::TileBounds& tile, float margin) {
  if (!cover_.meets(tile, margin)) return false;
  mirrored_.selectVisible(tile, margin);
  return true;
}

float ReflectedFrame::share(const View& view, float x, float y, float depth) const {
  constexpr float kSamePlace = 1.001f;  // the floor's varnish is where the floor is
  const Eigen::Vector3f direction = view.R_mirror_camera * Eigen::Vector3f(x, y, 1.0f);
  const float mirror_depth = -view.p_camera.z() / direction.z();
  if (!(mirror_depth > 0.0f && mirror_depth <= kSamePlace * depth)) return 0.0f;
  const Eigen::Vector3f p = view.p_camera + mirror_depth * direction;
  if (std::fabs(p.x()) > static_cast<float>(mirror_.half_x_m) ||
      std::fabs(p.y()) > static_cast<float>(mirror_.half_y_m))
    return 0.0f;
  return mirroredShare(static_cast<float>(mirror_.reflectance), std::fabs(direction.z()) / direction.norm());
}

void ReflectedFrame::apply(const RaySpan& seen, int row, int sample, int count, const Footprint& footprint,
                           float weight, float* light) const {
  const View& view = views_[mirrored_.instantOf(row, sample)];
  std::array<float, RaySpan::kLength> shares{}, mirrored{};
  bool any = false;
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    shares[at] = share(view, seen.x[i], seen.y[i], seen.depth[at]);
    any = any || shares[at] > 0.0f;
  }
  if (!any) return;
  const RaySpan span = mirrored_.cast(seen.x, seen.y, row, sample);
  shadeSpan(mirrored_.candidates(row, sample), span, count, footprint, weight, mirrored.data());
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    light[i] += shares[at] * (mirrored[at] - light[i]);
  }
}

}  // namespace stereo_nav::sim
