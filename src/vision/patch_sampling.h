#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>

/// Windows of a pyramid's level in integers, which fit vector instructions; they may reach into its border.
namespace stereo_nav::vision {

constexpr int kFractionBits = 3;  ///< intensities in eighths: sums of 21 x 21 products stay below 2^31

/// Bilinear samples of the rows x stride px whose first is at `corner`, in eighths of a grey level.
void sample(const cv::Mat& image, const cv::Point2f& corner, int rows, int stride, std::int16_t* out);

/// Whether a patch of axes `step` around `centre` lies in the image and its border.
bool warpInside(const cv::Mat& image, const cv::Point2f& centre, const Eigen::Matrix2f& step, int half);

/// Samples like sample() around `centre`, along the axes `step` (image px per patch px): column c and row r
/// of the patch are at centre + step * (c - half, r - half). It uses fixed point, since it runs for every
/// track and level.
void sampleWarped(const cv::Mat& image, const cv::Point2f& centre, const Eigen::Matrix2f& step, int half,
                  int stride, std::int16_t* out);

}  // namespace stereo_nav::vision
