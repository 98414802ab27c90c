#pragma once

#include <limits>
#include <vector>

#include "sim/ray_span.h"
#include "sim/renderer.h"

namespace stereo_nav::sim {

/// Depth of what no ray meets, and the bounds of an empty rectangle.
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Data that all tiles of one image share: every solid as seen at the instant of each row and sample, and the
/// part of the image that it can cover.
class RenderedFrame {
 public:
  RenderedFrame(const Scene& scene, const CameraPath& T_world_camera, const Shutter& shutter, int height,
                int samples);

  /// Chooses the solids that a tile's rays can meet, nearest first.
  void selectVisible(const Renderer::TileBounds& tile, float margin);

  /// Casts kLength rays of the selected tile; hits are indices into candidates(row, sample).
  RaySpan cast(const float* x, const float* y, int row, int sample) const;

  const std::vector<Candidate>& candidates(int row, int sample) const;

 private:
  /// Rectangle of ray coordinates that a solid can cover, and its smallest depth.
  struct Cover {
    float x_min, x_max, y_min, y_max;
    float nearest;
  };

  Cover coverOf(const Candidate& first, const Candidate& last) const;

  int samples_;
  bool global_shutter_;
  std::vector<std::vector<Candidate>> candidates_;  ///< [row][sample], one row for a global shutter
  std::vector<Cover> covers_;
  std::vector<int> order_;  ///< of solids, nearest first, the room last
  std::vector<int> visible_;
};

}  // namespace stereo_nav::sim
