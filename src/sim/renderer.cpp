#include "stereo_nav/sim/renderer.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "ray_span.h"

namespace stereo_nav::sim {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Where in the pixel sample `index` of `count` lies, in [-0.5, 0.5): a lattice with all columns and all rows
/// different, in another order than the times of the samples, and with mean 0.
Eigen::Vector2d offsetInPixel(int index, int count) {
  const int shuffled_x = (index % 2) * ((count + 1) / 2) + index / 2;
  const int stride_y = count >= 4 ? count / 2 + (count % 4 == 0 ? 1 : 0) : 1;
  const int shuffled_y = count == 2 ? 1 - index : (index * stride_y + count / 2) % count;
  const double scale = 1.0 / count;
  return {(shuffled_x + 0.5) * scale - 0.5, (shuffled_y + 0.5) * scale - 0.5};
}

/// Rectangle of ray coordinates that a solid can cover; empty when it is behind the camera.
struct Cover {
  float x_min = kInfinity, x_max = -kInfinity, y_min = kInfinity, y_max = -kInfinity;
};

void extend(Cover& cover, const Solid& solid, const Eigen::Isometry3d& T_world_camera, double time_s) {
  constexpr float kNear_m = 0.05f;
  const Candidate candidate = makeCandidate(solid, T_world_camera, time_s);
  const Eigen::Matrix3f R_camera_solid = candidate.R_solid_camera.transpose();
  int in_front = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3f sign(corner & 1 ? 1.f : -1.f, corner & 2 ? 1.f : -1.f, corner & 4 ? 1.f : -1.f);
    const Eigen::Vector3f p = R_camera_solid * (sign.cwiseProduct(solid.half) - candidate.p_camera);
    if (p.z() < kNear_m) continue;
    ++in_front;
    const float x = p.x() / p.z(), y = p.y() / p.z();
    cover = {std::min(cover.x_min, x), std::max(cover.x_max, x), std::min(cover.y_min, y), std::max(cover.y_max, y)};
  }
  if (in_front > 0 && in_front < 8) cover = {-kInfinity, kInfinity, -kInfinity, kInfinity};
}

}  // namespace

Renderer::Renderer(const Scene& scene, const CameraCalibration& calibration, int samples)
    : scene_(scene),
      width_(calibration.width),
      height_(calibration.height),
      stride_((calibration.width + kTile - 1) / kTile * kTile),
      samples_(samples),
      ray_pitch_(static_cast<float>(1.0 / calibration.K(0, 0))) {
  static_assert(kTile == RaySpan::kLength, "a tile's row is cast as one span");
  if (samples < 1 || samples > 16) {
    throw std::invalid_argument("renderer: samples per pixel is " + std::to_string(samples) + ", allowed is 1 to 16");
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
        // Past the right border the last ray is repeated; those samples are thrown away.
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

cv::Mat Renderer::render(const CameraPath& T_world_camera, const Shutter& shutter) const {
  const auto timeOf = [&](double row, int sample) {
    return shutter.middle_s + shutter.readout_s * ((row + 0.5) / height_ - 0.5) +
           shutter.exposure_s * ((sample + 0.5) / samples_ - 0.5);
  };
  std::vector<Cover> covers;
  const double first_s = timeOf(0, 0), last_s = timeOf(height_ - 1, samples_ - 1);
  const Eigen::Isometry3d T_first = T_world_camera(first_s), T_last = T_world_camera(last_s);
  for (const Solid& solid : scene_.solids()) {
    Cover cover;
    extend(cover, solid, T_first, first_s);
    extend(cover, solid, T_last, last_s);
    covers.push_back(cover);
  }

  cv::Mat light = cv::Mat::zeros(height_, width_, CV_32FC1);
  std::vector<Eigen::Isometry3d> poses(static_cast<std::size_t>(kTile * samples_));
  std::vector<const Solid*> visible;
  std::vector<Candidate> candidates;
  const float weight = 1.0f / static_cast<float>(samples_);
  const float margin = 2.0f * ray_pitch_;

  for (int top = 0; top < height_; top += kTile) {
    const int rows = std::min(kTile, height_ - top);
    for (int row = 0; row < rows; ++row) {
      for (int sample = 0; sample < samples_; ++sample) {
        poses[static_cast<std::size_t>(row * samples_ + sample)] = T_world_camera(timeOf(top + row, sample));
      }
    }
    for (int left = 0; left < stride_; left += kTile) {
      const TileBounds& tile = tiles_[static_cast<std::size_t>(top / kTile * (stride_ / kTile) + left / kTile)];
      visible.clear();
      for (std::size_t i = 0; i < covers.size(); ++i) {
        const Cover& cover = covers[i];
        if (cover.x_min - margin <= tile.x_max && cover.x_max + margin >= tile.x_min &&
            cover.y_min - margin <= tile.y_max && cover.y_max + margin >= tile.y_min) {
          visible.push_back(&scene_.solids()[i]);
        }
      }
      const int columns = std::min(kTile, width_ - left);
      for (int row = 0; row < rows; ++row) {
        float* out = light.ptr<float>(top + row) + left;
        for (int sample = 0; sample < samples_; ++sample) {
          const double time_s = timeOf(top + row, sample);
          const Eigen::Isometry3d& pose = poses[static_cast<std::size_t>(row * samples_ + sample)];
          const std::size_t start =
              static_cast<std::size_t>((sample * height_ + top + row) * stride_ + left);
          RaySpan span;
          span.x = ray_x_.data() + start;
          span.y = ray_y_.data() + start;
          span.depth.fill(kInfinity);
          span.hit.fill(-1);
          candidates.clear();
          for (const Solid* solid : visible) {
            candidates.push_back(makeCandidate(*solid, pose, time_s));
            castSpan(candidates.back(), static_cast<int>(candidates.size()) - 1, span);
          }
          const Footprint footprint{ray_pitch_, (static_cast<float>(sample) + 0.5f) * weight};
          for (int i = 0; i < columns; ++i) {
            const auto at = static_cast<std::size_t>(i);
            if (span.hit[at] < 0) continue;
            out[i] += weight * shade(candidates[static_cast<std::size_t>(span.hit[at])], span.x[i], span.y[i],
                                     span.depth[at], footprint);
          }
        }
      }
    }
  }
  return light;
}

}  // namespace stereo_nav::sim
