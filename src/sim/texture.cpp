#include "sim/texture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "sim/random.h"

namespace stereo_nav::sim {
namespace {

constexpr int kSize = Texture::kSize;

/// 1/f noise that repeats: octaves of random grids, each half the wavelength and half the amplitude of the
/// last.
cv::Mat fractalNoise(RandomStream& random, int coarsest_cells, int finest_cells) {
  cv::Mat sum = cv::Mat::zeros(kSize, kSize, CV_32FC1);
  float amplitude = 1.0f;
  for (int cells = coarsest_cells; cells <= finest_cells; cells *= 2, amplitude *= 0.5f) {
    cv::Mat grid(cells, cells, CV_32FC1);
    for (float& value : cv::Mat_<float>(grid)) value = static_cast<float>(random.normal());
    cv::Mat wrapped, large;
    cv::copyMakeBorder(grid, wrapped, 2, 2, 2, 2, cv::BORDER_WRAP);
    const int cell_px = kSize / cells;
    cv::resize(wrapped, large, cv::Size(), cell_px, cell_px, cv::INTER_CUBIC);
    sum += amplitude * large(cv::Rect(2 * cell_px, 2 * cell_px, kSize, kSize));
  }
  return sum;
}

/// Draws with `paint(canvas, shift)` at every shift by a period, so that shapes across a border go on at the
/// other side.
template <class Paint>
void paintWrapped(cv::Mat& canvas, Paint paint) {
  for (int dy = -kSize; dy <= kSize; dy += kSize) {
    for (int dx = -kSize; dx <= kSize; dx += kSize) paint(canvas, cv::Point2f(float(dx), float(dy)));
  }
}

void fillQuad(cv::Mat& canvas, cv::Point2f centre, cv::Size2f size, float angle_deg, double grey) {
  constexpr int kSubpixelBits = 4;
  paintWrapped(canvas, [&](cv::Mat& image, cv::Point2f shift) {
    cv::Point2f corners[4];
    cv::RotatedRect(centre + shift, size, angle_deg).points(corners);
    cv::Point fixed[4];
    for (int i = 0; i < 4; ++i) fixed[i] = corners[i] * float(1 << kSubpixelBits);
    cv::fillConvexPoly(image, fixed, 4, cv::Scalar(grey), cv::LINE_AA, kSubpixelBits);
  });
}

void fillDisc(cv::Mat& canvas, cv::Point2f centre, float radius, double grey) {
  paintWrapped(canvas, [&](cv::Mat& image, cv::Point2f shift) {
    cv::circle(image, centre + shift, std::max(1, cvRound(radius)), cv::Scalar(grey), cv::FILLED,
               cv::LINE_AA);
  });
}

/// Radius with density ~ r^-3 between the bounds: scale invariant, as in natural images.
float powerLawRadius(RandomStream& random, double smallest, double largest) {
  const double a = 1.0 / (smallest * smallest), b = 1.0 / (largest * largest);
  return static_cast<float>(1.0 / std::sqrt(random.uniform(b, a)));
}

struct LeafStyle {
  int count;
  double smallest_px, largest_px;
  double disc_share;      ///< the others are rectangles
  double tilt_sigma_deg;  ///< of rectangles from the axes
  double largest_aspect;
};

/// Draws large shapes first, so that they do not cover all small ones; grey values in [0, 255].
void paintLeaves(cv::Mat& canvas, RandomStream& random, const LeafStyle& style) {
  std::vector<float> radii;
  for (int i = 0; i < style.count; ++i) {
    radii.push_back(powerLawRadius(random, style.smallest_px, style.largest_px));
  }
  std::sort(radii.rbegin(), radii.rend());
  for (const float radius : radii) {
    const cv::Point2f centre(float(random.uniform(0, kSize)), float(random.uniform(0, kSize)));
    const double grey = random.uniform(10, 245);
    if (random.uniform(0, 1) < style.disc_share) {
      fillDisc(canvas, centre, radius, grey);
    } else {
      const float aspect = float(random.uniform(1.0, style.largest_aspect));
      const cv::Size2f size(2 * radius * aspect, 2 * radius / aspect);
      const bool upright = random.uniform(0, 1) < 0.5;
      fillQuad(canvas, centre, size, float((upright ? 90.0 : 0.0) + style.tilt_sigma_deg * random.normal()),
               grey);
    }
  }
}

/// Courses of rectangles with joints; `joint` darker than the stones, whose greys vary by `spread`.
void paintCourses(cv::Mat& canvas, RandomStream& random, int rows, int columns, bool staggered, int joint_px,
                  double grey, double spread, double joint_grey) {
  canvas.setTo(joint_grey);
  const float height = float(kSize) / float(rows), width = float(kSize) / float(columns);
  for (int row = 0; row < rows; ++row) {
    const float shift = staggered && row % 2 == 1 ? width / 2 : 0.0f;
    for (int column = 0; column < columns; ++column) {
      const cv::Point2f centre(shift + (float(column) + 0.5f) * width, (float(row) + 0.5f) * height);
      fillQuad(canvas, centre, {width - float(joint_px), height - float(joint_px)}, 0.0f,
               grey + spread * random.normal());
    }
  }
}

void paintWindow(cv::Mat& canvas) {
  canvas.setTo(60);
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      fillQuad(canvas, {128.0f + 256.0f * float(column), 128.0f + 256.0f * float(row)}, {228, 228}, 0.0f,
               225);
    }
  }
}

void paintChecker(cv::Mat& canvas) {
  constexpr int kSquare = 32;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) canvas.at<float>(y, x) = (x / kSquare + y / kSquare) % 2 ? 230.0f : 25.0f;
  }
}

/// The image in grey levels, before it is brought to mean 0.
cv::Mat paintTexture(TextureKind kind, std::uint64_t seed) {
  RandomStream random(streamKey(seed, Stream::kTexture, kind));
  cv::Mat leaves(kSize, kSize, CV_8UC1, cv::Scalar(128));
  cv::Mat canvas(kSize, kSize, CV_32FC1, cv::Scalar(128));
  switch (kind) {
    case TextureKind::kPlain:
      canvas += 14.0 * fractalNoise(random, 4, 128);
      break;
    case TextureKind::kFloor:
      paintLeaves(leaves, random, {900, 1.2, 40.0, 0.5, 40.0, 4.0});
      leaves.convertTo(canvas, CV_32F, 0.45);
      canvas += 18.0 * fractalNoise(random, 8, 512);
      break;
    case TextureKind::kWood:
      paintCourses(leaves, random, 8, 2, true, 3, 130, 22, 40);
      leaves.convertTo(canvas, CV_32F);
      {  // grain: noise stretched along the boards
        cv::Mat grain;
        cv::blur(fractalNoise(random, 64, 512), grain, cv::Size(41, 1));
        canvas += 45.0 * grain;
      }
      break;
    case TextureKind::kTiles:
      paintCourses(leaves, random, 16, 8, true, 6, 140, 18, 75);
      leaves.convertTo(canvas, CV_32F);
      canvas += 9.0 * fractalNoise(random, 8, 512);
      break;
    case TextureKind::kClutter:
      paintLeaves(leaves, random, {420, 9.0, 240.0, 0.2, 3.0, 2.5});
      leaves.convertTo(canvas, CV_32F);
      canvas += 8.0 * fractalNoise(random, 4, 512);
      break;
    case TextureKind::kCloth:
      paintLeaves(leaves, random, {120, 6.0, 120.0, 0.4, 30.0, 2.0});
      cv::GaussianBlur(leaves, leaves, cv::Size(), 2.0);
      leaves.convertTo(canvas, CV_32F, 0.5);
      canvas += 30.0 * fractalNoise(random, 4, 256);
      break;
    case TextureKind::kWindow:
      paintWindow(canvas);
      break;
    case TextureKind::kChecker:
      paintChecker(canvas);
      break;
  }
  return canvas;
}

}  // namespace

const std::vector<std::pair<std::string, TextureKind>>& textureNames() {
  static const std::vector<std::pair<std::string, TextureKind>> names = {
      {"plain", TextureKind::kPlain},   {"floor", TextureKind::kFloor},     {"wood", TextureKind::kWood},
      {"tiles", TextureKind::kTiles},   {"clutter", TextureKind::kClutter}, {"cloth", TextureKind::kCloth},
      {"window", TextureKind::kWindow}, {"checker", TextureKind::kChecker}};
  return names;
}

Texture::Texture(TextureKind kind, std::uint64_t seed) {
  const cv::Mat painted = paintTexture(kind, seed);
  buildPyramid((painted - cv::mean(painted)[0]) / 128.0);
}

Texture::Texture(const cv::Mat& image) {
  if (image.rows != kSize || image.cols != kSize || image.type() != CV_32FC1) {
    throw std::invalid_argument("texture: the image must be CV_32FC1 with 1024 x 1024 texels");
  }
  buildPyramid(image);
}

void Texture::buildPyramid(const cv::Mat& image) {
  cv::Mat level = image;
  for (int size = kSize, shift = 10; size >= 1; size /= 2, --shift) {
    if (size < level.cols) cv::resize(level, level, cv::Size(size, size), 0, 0, cv::INTER_AREA);
    Level stored;
    stored.mask = size - 1;
    stored.shift = shift;
    stored.scale = float(size) / float(kSize);
    for (const float value : cv::Mat_<float>(level)) {
      stored.texels.push_back(static_cast<std::int8_t>(cvRound(127.0f * std::clamp(value, -1.0f, 1.0f))));
    }
    pyramid_.push_back(std::move(stored));
  }
}

}  // namespace stereo_nav::sim
