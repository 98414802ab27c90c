#include "sim/rendered_frame.h"

#include <algorithm>
#include <numeric>

namespace stereo_nav::sim {

CameraInstants cameraInstants(const CameraPath& T_world_camera, const Shutter& shutter, int height,
                              int samples) {
  CameraInstants instants{{}, samples, shutter.readout_s == 0.0};
  const int rows = instants.global_shutter ? 1 : height;
  for (int row = 0; row < rows; ++row) {
    for (int sample = 0; sample < samples; ++sample) {
      const double time_s = shutter.middle_s + shutter.readout_s * ((row + 0.5) / rows - 0.5) +
                            shutter.exposure_s * ((sample + 0.5) / samples - 0.5);
      instants.list.push_back({time_s, T_world_camera(time_s)});
    }
  }
  return instants;
}

RenderedFrame::RenderedFrame(const std::vector<const Solid*>& solids, const CameraInstants& instants)
    : samples_(instants.samples), global_shutter_(instants.global_shutter) {
  for (const CameraInstant& instant : instants.list) {
    std::vector<Candidate> candidates;
    candidates.reserve(solids.size());
    for (const Solid* solid : solids) {
      candidates.push_back(makeCandidate(*solid, instant.T_world_camera, instant.time_s));
    }
    candidates_.push_back(std::move(candidates));
  }
  for (std::size_t i = 0; i < solids.size(); ++i) {
    covers_.push_back(coverOf(candidates_.front()[i], candidates_.back()[i]));
  }
  order_.resize(covers_.size());
  std::iota(order_.begin(), order_.end(), 0);
  const auto nearest = [this](int solid) { return covers_[static_cast<std::size_t>(solid)].nearest; };
  std::stable_sort(order_.begin(), order_.end(), [&](int a, int b) { return nearest(a) < nearest(b); });
}

RenderedFrame::Cover RenderedFrame::coverOf(const Candidate& first, const Candidate& last) {
  constexpr float kNear_m = 0.05f;
  // The room lies behind everything else: it is cast last, and only where nothing else was hit.
  if (first.solid->kind == Solid::Kind::kRoom)
    return {-kInfinity, kInfinity, -kInfinity, kInfinity, kInfinity};
  Cover cover{kInfinity, -kInfinity, kInfinity, -kInfinity, kInfinity};
  int in_front = 0;
  for (const Candidate* candidate : {&first, &last}) {
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3f sign(corner & 1 ? 1.f : -1.f, corner & 2 ? 1.f : -1.f, corner & 4 ? 1.f : -1.f);
      const Eigen::Vector3f p = candidate->R_solid_camera.transpose() *
                                (sign.cwiseProduct(candidate->solid->half) - candidate->p_camera);
      if (p.z() < kNear_m) continue;
      ++in_front;
      const float x = p.x() / p.z(), y = p.y() / p.z();
      cover = {std::min(cover.x_min, x), std::max(cover.x_max, x), std::min(cover.y_min, y),
               std::max(cover.y_max, y), std::min(cover.nearest, p.z())};
    }
  }
  const bool partly_behind = in_front > 0 && in_front < 16;
  if (partly_behind) return {-kInfinity, kInfinity, -kInfinity, kInfinity, 0.0f};
  cover.nearest *= 0.99f;  // it moves between the first and the last instant
  return cover;
}

void RenderedFrame::selectVisible(const Renderer::TileBounds& tile, float margin) {
  visible_.clear();
  for (const int solid : order_) {
    if (covers_[static_cast<std::size_t>(solid)].meets(tile, margin)) visible_.push_back(solid);
  }
}

RaySpan RenderedFrame::cast(const float* x, const float* y, int row, int sample) const {
  RaySpan span{x, y, {}, {}};
  span.depth.fill(kInfinity);
  span.hit.fill(-1);
  const std::vector<Candidate>& all = candidates(row, sample);
  float farthest = kInfinity;
  for (const int solid : visible_) {
    const auto index = static_cast<std::size_t>(solid);
    if (covers_[index].nearest > farthest) break;  // hidden, like all that follow
    castSpan(all[index], solid, span);
    farthest = farthestDepth(span);
  }
  return span;
}

}  // namespace stereo_nav::sim
