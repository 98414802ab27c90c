#include "sim/ray_span.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace stereo_nav::sim {
namespace {

constexpr int kLength = RaySpan::kLength;
/// Diameter of what one of several samples of a pixel stands for, in pixels, across and along the slant.
constexpr float kMinorFootprint = 0.6f;
constexpr float kMajorFootprint = 0.25f;
constexpr float kTapSpacing = 1.5f;  ///< in footprints across; what is more is read from a coarser level
constexpr int kMaxTaps = 3;
/// Light on the sides of solids: a window front is on one side of the hall, lamps are above.
constexpr float kSideX[2] = {0.95f, 0.82f};
constexpr float kSideY[2] = {0.74f, 1.0f};

/// Entry and exit depths of kLength rays through the three slabs of a box, or the mantle and two ends of a
/// cylinder.
struct SpanIntervals {
  alignas(16) float near[kLength];
  alignas(16) float far[kLength];
};

void intersectBox(const Candidate& candidate, const RaySpan& span, SpanIntervals& result) {
  const Eigen::Matrix3f& R = candidate.R_solid_camera;
  const Eigen::Vector3f& o = candidate.p_camera;
  const Eigen::Vector3f& h = candidate.solid->half;
  for (int i = 0; i < kLength; ++i) {
    const float ix = 1.0f / (R(0, 0) * span.x[i] + R(0, 1) * span.y[i] + R(0, 2));
    const float iy = 1.0f / (R(1, 0) * span.x[i] + R(1, 1) * span.y[i] + R(1, 2));
    const float iz = 1.0f / (R(2, 0) * span.x[i] + R(2, 1) * span.y[i] + R(2, 2));
    const float x1 = (-h.x() - o.x()) * ix, x2 = (h.x() - o.x()) * ix;
    const float y1 = (-h.y() - o.y()) * iy, y2 = (h.y() - o.y()) * iy;
    const float z1 = (-h.z() - o.z()) * iz, z2 = (h.z() - o.z()) * iz;
    result.near[i] = std::max(std::max(std::min(x1, x2), std::min(y1, y2)), std::min(z1, z2));
    result.far[i] = std::min(std::min(std::max(x1, x2), std::max(y1, y2)), std::max(z1, z2));
  }
}

void intersectCylinder(const Candidate& candidate, const RaySpan& span, SpanIntervals& result) {
  const Eigen::Matrix3f& R = candidate.R_solid_camera;
  const Eigen::Vector3f& o = candidate.p_camera;
  const float radius = candidate.solid->half.x(), half_z = candidate.solid->half.z();
  const float c = o.x() * o.x() + o.y() * o.y() - radius * radius;
  for (int i = 0; i < kLength; ++i) {
    const float dx = R(0, 0) * span.x[i] + R(0, 1) * span.y[i] + R(0, 2);
    const float dy = R(1, 0) * span.x[i] + R(1, 1) * span.y[i] + R(1, 2);
    const float iz = 1.0f / (R(2, 0) * span.x[i] + R(2, 1) * span.y[i] + R(2, 2));
    const float a = dx * dx + dy * dy, b = o.x() * dx + o.y() * dy;
    const float discriminant = b * b - a * c;
    const float root = std::sqrt(std::max(discriminant, 0.0f)), ia = 1.0f / a;
    const float z1 = (-half_z - o.z()) * iz, z2 = (half_z - o.z()) * iz;
    result.near[i] = std::max((-b - root) * ia, std::min(z1, z2));
    const float far = std::min((-b + root) * ia, std::max(z1, z2));
    result.far[i] = discriminant > 0.0f ? far : -1.0f;
  }
}

/// log2 from the bits of the float, linear between powers of two: at most 0.09 too small.
float fastLog2(float value) {
  std::int32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return static_cast<float>(bits) * 0x1.0p-23f - 127.0f;
}

/// Where and on which face a solid was hit: coordinates on the surface in metres, and along which of the
/// solid's directions they run.
struct SurfacePoint {
  const Surface* surface;
  float u, v;
  float light;
  int normal_axis;  ///< 0 to 2 of the solid's axes, 3 for a cylinder's mantle
};

SurfacePoint onBox(const Solid& solid, const Eigen::Vector3f& p) {
  const Eigen::Vector3f share = p.cwiseAbs().cwiseProduct(solid.inverse_half);
  if (share.z() > share.x() && share.z() > share.y()) {
    return {p.z() > 0.0f ? &solid.top : &solid.floor, p.x(), p.y(), 1.0f, 2};
  }
  // Each side shows a different piece of the texture.
  if (share.x() > share.y()) {
    const bool front = p.x() > 0.0f;
    return {&solid.sides, p.y() + (front ? 1.7f : 0.0f), p.z(), kSideX[front], 0};
  }
  const bool left = p.y() > 0.0f;
  return {&solid.sides, p.x() + (left ? 3.1f : 2.3f), p.z(), kSideY[left], 1};
}

SurfacePoint onCylinder(const Solid& solid, const Eigen::Vector3f& p) {
  const float radius = solid.half.x();
  if (p.head<2>().squaredNorm() < 0.998f * radius * radius) {
    return {p.z() > 0.0f ? &solid.top : &solid.floor, p.x(), p.y(), 1.0f, 2};
  }
  const float nx = p.x() / radius, ny = p.y() / radius;
  return {&solid.sides, radius * std::atan2(p.y(), p.x()), p.z(), 0.85f + 0.07f * nx + 0.13f * ny, 3};
}

/// Which pyramid level to read, in how many taps and how far apart, in texels.
struct Taps {
  int level;
  int count;
  float inverse_count;
  float first_u, first_v;  ///< from the middle to the first tap
  float step_u, step_v;
};

/// The footprint of a sample on a slanted surface is an ellipse: its short axis sets the level, taps are
/// strung along its long axis, which lies where the ray falls onto the surface.
Taps planTaps(const SurfacePoint& point, const Eigen::Vector3f& p, const Eigen::Vector3f& d, float depth,
              const Footprint& footprint) {
  float normal, along_u, along_v;
  switch (point.normal_axis) {
    case 0:
      normal = d.x(), along_u = d.y(), along_v = d.z();
      break;
    case 1:
      normal = d.y(), along_u = d.x(), along_v = d.z();
      break;
    case 2:
      normal = d.z(), along_u = d.x(), along_v = d.y();
      break;
    default: {
      const float inverse_radius = 1.0f / p.head<2>().norm();
      normal = (d.x() * p.x() + d.y() * p.y()) * inverse_radius;
      along_u = (d.y() * p.x() - d.x() * p.y()) * inverse_radius;
      along_v = d.z();
    }
  }
  const Surface& surface = *point.surface;
  const float minor = kMinorFootprint * footprint.ray_pitch * depth * surface.texels_per_m;
  const float slant = d.norm() / std::max(std::fabs(normal), 1e-4f);
  const float major = minor * slant * (kMajorFootprint / kMinorFootprint);
  Taps taps{};
  taps.count = std::min(kMaxTaps, 1 + static_cast<int>(major / (kTapSpacing * minor)));
  taps.inverse_count = 1.0f / static_cast<float>(taps.count);
  const float step = major * taps.inverse_count;
  const float level = fastLog2(std::max(std::max(minor, step), 1.0f)) + footprint.level_bias;
  taps.level = std::min(static_cast<int>(level), surface.texture->levels() - 1);
  if (taps.count > 1) {
    const float scale = step / std::sqrt(along_u * along_u + along_v * along_v);
    taps.step_u = along_u * scale;
    taps.step_v = along_v * scale;
    taps.first_u = -0.5f * static_cast<float>(taps.count - 1) * taps.step_u;
    taps.first_v = -0.5f * static_cast<float>(taps.count - 1) * taps.step_v;
  }
  return taps;
}

float readTexture(const SurfacePoint& point, const Taps& taps) {
  const Surface& surface = *point.surface;
  float u = point.u * surface.texels_per_m + surface.u_offset + taps.first_u;
  float v = point.v * surface.texels_per_m + surface.v_offset + taps.first_v;
  float sum = surface.texture->sample(u, v, taps.level);
  for (int tap = 1; tap < taps.count; ++tap) {
    u += taps.step_u;
    v += taps.step_v;
    sum += surface.texture->sample(u, v, taps.level);
  }
  return sum * taps.inverse_count;
}

}  // namespace

Candidate makeCandidate(const Solid& solid, const Eigen::Isometry3d& T_world_camera, double time_s) {
  return {&solid, (solid.R_solid_world * T_world_camera.linear()).cast<float>(),
          (solid.R_solid_world * (T_world_camera.translation() - solid.position(time_s))).cast<float>()};
}

void castSpan(const Candidate& candidate, int index, RaySpan& span) {
  SpanIntervals hits;
  if (candidate.solid->kind == Solid::Kind::kCylinder) {
    intersectCylinder(candidate, span, hits);
  } else {
    intersectBox(candidate, span, hits);
  }
  if (candidate.solid->kind == Solid::Kind::kRoom) {  // seen from inside: what counts is the exit
    std::copy(hits.far, hits.far + kLength, hits.near);
  }
  for (int i = 0; i < kLength; ++i) {
    const bool nearer =
        (hits.near[i] <= hits.far[i]) & (hits.near[i] > 0.0f) & (hits.near[i] < span.depth[i]);
    span.depth[i] = nearer ? hits.near[i] : span.depth[i];
    span.hit[i] = nearer ? index : span.hit[i];
  }
}

float farthestDepth(const RaySpan& span) {
  float farthest = 0.0f;
  for (const float depth : span.depth) farthest = std::max(farthest, depth);
  return farthest;
}

void shadeSpan(const std::vector<Candidate>& candidates, const RaySpan& span, int count,
               const Footprint& footprint, float weight, float* out) {
  // Footprints change slowly: one plan serves a run of neighbours on the same face.
  constexpr int kRun = 8;
  Taps taps{};
  int planned_hit = -1, planned_axis = -1, planned_at = 0;
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const int hit = span.hit[at];
    if (hit < 0) continue;
    const Candidate& candidate = candidates[static_cast<std::size_t>(hit)];
    const Solid& solid = *candidate.solid;
    const Eigen::Vector3f d = candidate.R_solid_camera * Eigen::Vector3f(span.x[i], span.y[i], 1.0f);
    const Eigen::Vector3f p = candidate.p_camera + span.depth[at] * d;
    const SurfacePoint point = solid.kind == Solid::Kind::kCylinder ? onCylinder(solid, p) : onBox(solid, p);
    if (hit != planned_hit || point.normal_axis != planned_axis || i >= planned_at + kRun) {
      taps = planTaps(point, p, d, span.depth[at], footprint);
      planned_hit = hit;
      planned_axis = point.normal_axis;
      planned_at = i;
    }
    const Surface& surface = *point.surface;
    out[i] += weight * surface.grey * point.light * (1.0f + surface.contrast * readTexture(point, taps));
  }
}

}  // namespace stereo_nav::sim
