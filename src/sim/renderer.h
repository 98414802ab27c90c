#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/camera.h"
#include "sim/scene.h"

namespace stereo_nav::sim {

/// When the light of one image is collected. A row's exposure is centred on
/// `middle_s + readout_s * ((row + 0.5) / height - 0.5)`; a global shutter has no readout time.
struct Shutter {
  double middle_s = 0.0;
  double exposure_s = 0.0;
  double readout_s = 0.0;
};

class ReflectedFrame;
class RenderedFrame;

/// Pose of the raw optical frame at a time: T_world_camera. Called from the rendering thread.
using CameraPath = std::function<Eigen::Isometry3d(double time_s)>;

/// Casts rays from one camera into scenes. Every pixel is the mean of `samples` rays that are spread over
/// its area and over the exposure time at once, so that edges are smooth and motion blurs; textures are read
/// from pyramids, along the slant of the surface with several taps. Mirrors add what a second ray meets. The
/// rays of the distorted pixels are computed once. Const methods may be called from several threads.
class Renderer {
 public:
  /// `samples` per pixel, 1 to 16.
  Renderer(const CameraCalibration& calibration, int samples);

  /// Rectangle of ray coordinates (x/z, y/z) that a tile of the image sees.
  struct TileBounds {
    float x_min, x_max, y_min, y_max;
  };

  cv::Size size() const { return {width_, height_}; }

  /// Light on the sensor in grey levels of a perfect 8 bit camera, CV_32FC1, not limited to 255.
  cv::Mat render(const Scene& scene, const CameraPath& T_world_camera, const Shutter& shutter) const;

 private:
  static constexpr int kTile = 16;

  void computeRays(const CameraCalibration& calibration);
  void computeTileBounds();
  void renderTile(const RenderedFrame& frame, const std::vector<const ReflectedFrame*>& reflections, int top,
                  int left, cv::Mat& light) const;

  int width_, height_;
  int stride_;  ///< width rounded up to whole tiles
  int samples_;
  float ray_pitch_;                   ///< between neighbouring pixels
  std::vector<float> ray_x_, ray_y_;  ///< [sample][row][stride_]
  std::vector<TileBounds> tiles_;
};

}  // namespace stereo_nav::sim
