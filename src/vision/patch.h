#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>

namespace stereo_nav::vision {

/// A square piece of an image that can be found again in another one, whatever the gain and offset between
/// the two: inverse compositional Lucas-Kanade (Baker and Matthews 2004) with the gain solved for in every
/// step and the offset taken out by templates of zero mean. Images are levels of an ImagePyramid: patches may
/// reach into its border.
class Patch {
 public:
  static constexpr int kMaxWindow = 21;

  /// The `window` x `window` px around `centre`; `window` is odd. Nothing if the centre
  /// leaves the image or the patch has too little texture: the smaller eigenvalue of its gradient moments,
  /// per px, must be at least `min_texture` (grey levels per px, squared). `step` is the way in the image per
  /// px of the patch: the patch as it is expected in the other image.
  static std::optional<Patch> cut(const cv::Mat& image, const cv::Point2f& centre, int window,
                                  double min_texture,
                                  const Eigen::Matrix2f& step = Eigen::Matrix2f::Identity());

  struct Match {
    cv::Point2f px;
    float correlation;  ///< zero-mean normalised, -1 to 1, at the last position but one
    bool converged;     ///< the last step was shorter than `min_step_px`
  };
  /// Steps from `guess` to where `image` looks like the patch. Nothing if it leaves the image, if the best
  /// gain is outside 1/4 to 4, or if it wanders further than the window from the guess.
  std::optional<Match> align(const cv::Mat& image, const cv::Point2f& guess, int iterations,
                             double min_step_px) const;

  /// Correlation with the patch around a whole pixel of the image.
  float correlation(const cv::Mat& image, int x, int y) const;

 private:
  static constexpr int kMaxStride = 24;
  using Grid = std::array<std::int16_t, kMaxStride * kMaxWindow>;
  struct Sums;

  Sums correlate(const Grid& grid) const;

  int window_ = 0;
  int stride_ = 0;  ///< columns with padding: a multiple of 8
  // The values are in eighths of a grey level, with zero mean, and zero in the padding columns.
  alignas(16) Grid intensity_;
  alignas(16) Grid gradient_x_;
  alignas(16) Grid gradient_y_;
  alignas(16) std::array<std::int16_t, kMaxStride> mask_;  ///< 1 in the window, 0 in the padding
  Eigen::Matrix3f inverse_moments_;                        ///< of (gradient_x, gradient_y, intensity)
  float intensity_norm_ = 0.0F;
};

}  // namespace stereo_nav::vision
