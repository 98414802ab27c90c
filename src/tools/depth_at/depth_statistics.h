#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace stereo_nav::tools {

/// Median of the disparities above zero in a piece of a disparity map (CV_32FC1, px); nothing where fewer
/// than half of its pixels have one.
std::optional<double> medianDisparity(const cv::Mat& window);

/// The square of `size` px around a pixel. Throws InputError when it leaves the image.
cv::Rect windowAround(cv::Point pixel, int size, cv::Size image);

/// Distances over several frames.
class DepthStatistics {
 public:
  /// `depth_m`: distance along the view, nothing for a frame without disparity.
  void add(std::optional<double> depth_m);
  std::size_t frames() const { return frames_; }
  /// One line: mean, standard deviation and range, or why there is none.
  std::string text() const;

 private:
  std::vector<double> depths_m_;
  std::size_t frames_ = 0;
};

}  // namespace stereo_nav::tools
