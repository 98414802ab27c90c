#include "ray_span.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace stereo_nav::sim {
namespace {

constexpr int kLength = RaySpan::kLength;
/// Diameter of what one of several samples of a pixel stands for, in pixels, across and along the slant.
constexpr float kMinorFootprint = 0.6f;
constexpr float kMajorFootprint = 0.3f;
constexpr int kMaxTaps = 4;
/// Light on the sides: a window front on one side of the hall, lamps above.
constexpr float kSideX[2] = {0.95f, 0.82f};
constexpr float kSideY[2] = {0.74f, 1.0f};

/// Entry and exit of kLength rays through the three slabs of a box, or a cylinder's mantle and two ends.
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

/// Where and on which face a solid was hit: coordinates on the surface in metres, and the ray's components in
/// the same directions (last: along the normal).
struct SurfacePoint {
  const Surface* surface;
  float u, v;
  float ray_u, ray_v, ray_normal;
  float light;
};

SurfacePoint onBox(const Solid& solid, const Eigen::Vector3f& p, const Eigen::Vector3f& d) {
  const Eigen::Vector3f share = p.cwiseAbs().cwiseQuotient(solid.half);
  if (share.z() > share.x() && share.z() > share.y()) {
    return {p.z() > 0.0f ? &solid.top : &solid.floor, p.x(), p.y(), d.x(), d.y(), d.z(), 1.0f};
  }
  // The two sides of a box show different pieces of the texture.
  if (share.x() > share.y()) {
    const bool front = p.x() > 0.0f;
    return {&solid.sides, p.y() + (front ? 1.7f : 0.0f), p.z(), d.y(), d.z(), d.x(), kSideX[front]};
  }
  const bool left = p.y() > 0.0f;
  return {&solid.sides, p.x() + (left ? 3.1f : 2.3f), p.z(), d.x(), d.z(), d.y(), kSideY[left]};
}

SurfacePoint onCylinder(const Solid& solid, const Eigen::Vector3f& p, const Eigen::Vector3f& d) {
  const float radius = solid.half.x();
  if (p.head<2>().squaredNorm() < 0.998f * radius * radius) {
    return {p.z() > 0.0f ? &solid.top : &solid.floor, p.x(), p.y(), d.x(), d.y(), d.z(), 1.0f};
  }
  const float nx = p.x() / radius, ny = p.y() / radius;
  const float light = 0.85f + 0.07f * nx + 0.13f * ny;
  return {&solid.sides,           radius * std::atan2(p.y(), p.x()), p.z(), d.y() * nx - d.x() * ny, d.z(),
          d.x() * nx + d.y() * ny, light};
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
    const bool nearer = (hits.near[i] <= hits.far[i]) & (hits.near[i] > 0.0f) & (hits.near[i] < span.depth[i]);
    span.depth[i] = nearer ? hits.near[i] : span.depth[i];
    span.hit[i] = nearer ? index : span.hit[i];
  }
}

float shade(const Candidate& candidate, float x, float y, float depth, const Footprint& footprint) {
  const Solid& solid = *candidate.solid;
  const Eigen::Vector3f d = candidate.R_solid_camera * Eigen::Vector3f(x, y, 1.0f);
  const Eigen::Vector3f p = candidate.p_camera + depth * d;
  const SurfacePoint point =
      solid.kind == Solid::Kind::kCylinder ? onCylinder(solid, p, d) : onBox(solid, p, d);
  const Surface& surface = *point.surface;

  const float minor = kMinorFootprint * footprint.ray_pitch * depth * surface.texels_per_m;
  const float in_plane = std::sqrt(point.ray_u * point.ray_u + point.ray_v * point.ray_v);
  const float slant = std::sqrt(x * x + y * y + 1.0f) / std::max(std::fabs(point.ray_normal), 1e-4f);
  const float major = minor * slant * (kMajorFootprint / kMinorFootprint);
  const int taps = major > minor ? std::min(kMaxTaps, 1 + static_cast<int>(major / minor)) : 1;
  const float step = major / static_cast<float>(taps);
  const float level_real = fastLog2(std::max(std::max(minor, step), 1.0f)) + footprint.level_bias;
  const int level = std::min(static_cast<int>(level_real), surface.texture->levels() - 1);

  const float u = point.u * surface.texels_per_m + surface.u_offset;
  const float v = point.v * surface.texels_per_m + surface.v_offset;
  float texture = 0.0f;
  if (taps == 1) {
    texture = surface.texture->sample(u, v, level);
  } else {
    const float du = step * point.ray_u / in_plane, dv = step * point.ray_v / in_plane;
    const float first = 0.5f - 0.5f * static_cast<float>(taps);
    for (int tap = 0; tap < taps; ++tap) {
      const float at = first + static_cast<float>(tap);
      texture += surface.texture->sample(u + at * du, v + at * dv, level);
    }
    texture /= static_cast<float>(taps);
  }
  return surface.grey * point.light * (1.0f + surface.contrast * texture);
}

}  // namespace stereo_nav::sim
