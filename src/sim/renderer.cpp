#include "sim/renderer.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "sim/ray_span.h"
#include "sim/reflected_frame.h"
#include "sim/rendered_frame.h"

namespace stereo_nav::sim {
namespace {

/// Where in the pixel sample `index` of `count` lies, in [-0.5, 0.5): a lattice with all columns and all rows
/// different, in another order than the times of the samples, and with mean 0.
Eigen::Vector2d offsetInPixel(int index, int count) {
  const int shuffled_x = (index % 2) * ((count + 1) / 2) + index / 2;
  const int stride_y = count >= 4 ? count / 2 + (count % 4 == 0 ? 1 : 0) : 1;
  const int shuffled_y = count == 2 ? 1 - index : (index * stride_y + count / 2) % count;
  const double scale = 1.0 / count;
  return {(shuffled_x + 0.5) * scale - 0.5, (shuffled_y + 0.5) * scale - 0.5};
}

}  // namespace

Renderer::Renderer(const CameraCalibration& calibration, int samples)
    : width_(calibration.width),
      height_(calibration.height),
      stride_((calibration.width + kTile - 1) / kTile * kTile),
      samples_(samples),
      ray_pitch_(static_cast<float>(1.0 / calibration.K(0, 0))) {
  static_assert(kTile == RaySpan::kLength, "a tile's row is cast as one span");
  if (samples < 1 || samples > 16) {
    throw std::invalid_argument("renderer: samples per pixel is " + std::to_string(samples) +
                                ", allowed is 1 to 16");
  }
  computeRays(calibration);
  computeTileBounds();
}

void Renderer::computeRays(const CameraCalibration& calibration) {
  ray_x_.reserve(static_cast<std::size_t>(samples_ * height_ * stride_));
  ray_y_.reserve(ray_x_.capacity());
  for (int sample = 0; sample < samples_; ++sample) {
    const Eigen::Vector2d offset = offsetInPixel(sample, samples_);
    for (int row = 0; row < height_; ++row) {
      for (int column = 0; column < stride_; ++column) {
        // Beyond the right border the last ray is repeated; those samples are discarded.
        const Eigen::Vector2d pixel(std::min(column, width_ - 1), row);
        const Eigen::Vector2d ray = calibration.undistort(pixel + offset);
        ray_x_.push_back(static_cast<float>(ray.x()));
        ray_y_.push_back(static_cast<float>(ray.y()));
      }
    }
  }
}

void Renderer::computeTileBounds() {
  for (int top = 0; top < height_; top += kTile) {
    for (int left = 0; left < stride_; left += kTile) {
      TileBounds bounds{kInfinity, -kInfinity, kInfinity, -kInfinity};
      for (int sample = 0; sample < samples_; ++sample) {
        for (int row = top; row < std::min(top + kTile, height_); ++row) {
          const std::size_t start = static_cast<std::size_t>((sample * height_ + row) * stride_ + left);
          for (std::size_t i = start; i < start + kTile; ++i) {
            bounds.x_min = std::min(bounds.x_min, ray_x_[i]);
            bounds.x_max = std::max(bounds.x_max, ray_x_[i]);
            bounds.y_min = std::min(bounds.y_min, ray_y_[i]);
            bounds.y_max = std::max(bounds.y_max, ray_y_[i]);
          }
        }
      }
      tiles_.push_back(bounds);
    }
  }
}

cv::Mat Renderer::render(const Scene& scene, const CameraPath& T_world_camera, const Shutter& shutter) const {
  const CameraInstants instants = cameraInstants(T_world_camera, shutter, height_, samples_);
  RenderedFrame frame(scene.solidsAt(shutter.middle_s), instants);
  std::vector<ReflectedFrame> reflections;
  reflections.reserve(scene.mirrors().size());
  for (const Mirror& mirror : scene.mirrors()) reflections.emplace_back(scene, mirror, instants);
  cv::Mat light = cv::Mat::zeros(height_, width_, CV_32FC1);
  std::size_t tile = 0;
  for (int top = 0; top < height_; top += kTile) {
    for (int left = 0; left < stride_; left += kTile, ++tile) {
      frame.selectVisible(tiles_[tile], ray_pitch_);
      std::vector<const ReflectedFrame*> visible;
      for (ReflectedFrame& reflection : reflections) {
        if (reflection.selectVisible(tiles_[tile], ray_pitch_)) visible.push_back(&reflection);
      }
      renderTile(frame, visible, top, left, light);
    }
  }
  return light;
}

void Renderer::renderTile(const RenderedFrame& frame, const std::vector<const ReflectedFrame*>& reflections,
                          int top, int left, cv::Mat& light) const {
  const int count = std::min(kTile, width_ - left);
  const float weight = 1.0f / static_cast<float>(samples_);
  for (int row = top; row < std::min(top + kTile, height_); ++row) {
    float* out = light.ptr<float>(row) + left;
    for (int sample = 0; sample < samples_; ++sample) {
      const auto rays = static_cast<std::size_t>((sample * height_ + row) * stride_ + left);
      const RaySpan span = frame.cast(ray_x_.data() + rays, ray_y_.data() + rays, row, sample);
      const Footprint footprint{ray_pitch_,
                                (static_cast<float>(sample) + 0.5f) / static_cast<float>(samples_)};
      if (reflections.empty()) {
        shadeSpan(frame.candidates(row, sample), span, count, footprint, weight, out);
        continue;
      }
      std::array<float, kTile> seen{};
      shadeSpan(frame.candidates(row, sample), span, count, footprint, weight, seen.data());
      for (const ReflectedFrame* reflection : reflections) {
        reflection->apply(span, row, sample, count, footprint, weight, seen.data());
      }
      for (int i = 0; i < count; ++i) out[i] += seen[static_cast<std::size_t>(i)];
    }
  }
}

}  // namespace stereo_nav::sim
