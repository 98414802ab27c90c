#pragma once

#include <limits>
#include <vector>

#include "sim/ray_span.h"
#include "sim/renderer.h"

namespace stereo_nav::sim {

/// Depth of what no ray meets, and the bounds of an empty rectangle.
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Where the camera is at one moment of an image's exposure.
struct CameraInstant {
  double time_s;
  Eigen::Isometry3d T_world_camera;
};

/// The camera at all moments of an image's exposure: [row][sample], one row for a global shutter.
struct CameraInstants {
  std::vector<CameraInstant> list;
  int samples;
  bool global_shutter;
};

/// The instants of `samples` rays of each row, spread over its exposure.
CameraInstants cameraInstants(const CameraPath& T_world_camera, const Shutter& shutter, int height,
                              int samples);

/// Data that all tiles of one image share: every solid as seen at the instant of each row and sample, and the
/// part of the image that it can cover.
class RenderedFrame {
 public:
  /// Rectangle of ray coordinates that a solid can cover, and its smallest depth.
  struct Cover {
    float x_min, x_max, y_min, y_max;
    float nearest;

    bool meets(const Renderer::TileBounds& tile, float margin) const {
      return x_min - margin <= tile.x_max && x_max + margin >= tile.x_min && y_min - margin <= tile.y_max &&
             y_max + margin >= tile.y_min;
    }
  };

  /// What a solid covers that is seen so first and last.
  static Cover coverOf(const Candidate& first, const Candidate& last);

  RenderedFrame(const std::vector<const Solid*>& solids, const CameraInstants& instants);

  /// Chooses the solids that a tile's rays can meet, nearest first.
  void selectVisible(const Renderer::TileBounds& tile, float margin);

  /// Casts kLength rays of the selected tile; hits are indices into candidates(row, sample).
  RaySpan cast(const float* x, const float* y, int row, int sample) const;

  const std::vector<Candidate>& candidates(int row, int sample) const {
    return candidates_[instantOf(row, sample)];
  }

  /// Index of a row's sample in the list of instants.
  std::size_t instantOf(int row, int sample) const {
    return static_cast<std::size_t>((global_shutter_ ? 0 : row) * samples_ + sample);
  }

 private:
  int samples_;
  bool global_shutter_;
  std::vector<std::vector<Candidate>> candidates_;  ///< [row][sample], one row for a global shutter
  std::vector<Cover> covers_;
  std::vector<int> order_;  ///< of solids, nearest first, the room last
  std::vector<int> visible_;
};

}  // namespace stereo_nav::sim
