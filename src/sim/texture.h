#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <utility>
#include <vector>

namespace stereo_nav::sim {

/// What a surface looks like. All but kChecker are random with the statistics of natural images: occluding
/// shapes whose sizes follow a power law ("dead leaves", Lee, Mumford and Huang, 2001) over 1/f noise.
enum class TextureKind {
  kPlain,    ///< painted wall: faint 1/f mottling only
  kFloor,    ///< mat: fine speckle, scuffs
  kWood,     ///< boards with grain
  kTiles,    ///< bricks or tiles with joints
  kClutter,  ///< shelves, posters, boxes: overlapping rectangles and discs
  kCloth,    ///< person: soft folds and a few marks
  kWindow,   ///< bright panes in frames
  kChecker   ///< squares of 0.1 m at texel 4 mm, for tests
};

/// Names as in scenario files.
const std::vector<std::pair<std::string, TextureKind>>& textureNames();

/// A square, seamlessly repeating image with its pyramid. Values have mean 0 and lie in [-1, 1].
class Texture {
 public:
  static constexpr int kSize = 1024;  ///< texels on each side of level 0; a power of two

  /// Deterministic in (kind, seed).
  Texture(TextureKind kind, std::uint64_t seed);
  /// A texture from a CV_32FC1 image of kSize x kSize with values in [-1, 1].
  explicit Texture(const cv::Mat& image);

  int levels() const { return static_cast<int>(pyramid_.size()); }

  /// Bilinear value at (u, v) in texels of level 0 (any value, the image repeats), read from `level`.
  float sample(float u, float v, int level) const {
    const Level& image = pyramid_[static_cast<std::size_t>(level)];
    // Texel centres are at half-integers on each level.
    const float x = u * image.scale + kPositive - 0.5f;
    const float y = v * image.scale + kPositive - 0.5f;
    const int x0 = static_cast<int>(x);
    const int y0 = static_cast<int>(y);
    const float fx = x - static_cast<float>(x0);
    const float fy = y - static_cast<float>(y0);
    const std::int8_t* row0 = image.texels.data() + ((y0 & image.mask) << image.shift);
    const std::int8_t* row1 = image.texels.data() + (((y0 + 1) & image.mask) << image.shift);
    const int left = x0 & image.mask;
    const int right = (x0 + 1) & image.mask;
    const float top = static_cast<float>(row0[left]) + fx * static_cast<float>(row0[right] - row0[left]);
    const float bottom = static_cast<float>(row1[left]) + fx * static_cast<float>(row1[right] - row1[left]);
    return (top + fy * (bottom - top)) * (1.0f / 127.0f);
  }

 private:
  struct Level {
    std::vector<std::int8_t> texels;
    int mask;     ///< size - 1
    int shift;    ///< log2(size)
    float scale;  ///< size / kSize
  };
  /// Added so that truncation is floor; a multiple of every level's size, small enough for float to keep
  /// 1/128 texel.
  static constexpr float kPositive = 65536.0f;

  void buildPyramid(const cv::Mat& image);

  std::vector<Level> pyramid_;
};

}  // namespace stereo_nav::sim
