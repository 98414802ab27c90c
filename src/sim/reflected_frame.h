#pragma once

#include <vector>

#include "sim/mirror.h"
#include "sim/rendered_frame.h"

namespace stereo_nav::sim {

/// What one mirror adds to an image. The mirrored world is seen by casting the same rays from the mirrored
/// camera; mirrors within it are not followed.
class ReflectedFrame {
 public:
  ReflectedFrame(const Scene& scene, const Mirror& mirror, const CameraInstants& instants);

  /// Chooses the solids that a tile's rays can meet in the mirror; false if the tile does not see the mirror.
  bool selectVisible(const Renderer::TileBounds& tile, float margin);

  /// Lays the mirrored light over the light of the selected tile's rays. `light` of the first `count` rays is
  /// what they have met without the mirror, times `weight`.
  void apply(const RaySpan& seen, int row, int sample, int count, const Footprint& footprint, float weight,
             float* light) const;

 private:
  /// The camera in the mirror's frame at one instant.
  struct View {
    Eigen::Matrix3f R_mirror_camera;
    Eigen::Vector3f p_camera;
  };

  /// Share of a ray's light that comes from the mirror: 0 where it does not meet it first.
  float share(const View& view, float x, float y, float depth) const;

  const Mirror& mirror_;
  RenderedFrame mirrored_;
  std::vector<View> views_;
  RenderedFrame::Cover cover_;  ///< part of the image that the mirror can cover
};

}  // namespace stereo_nav::sim
