#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace stereo_nav::calibration {

/// A flat checkerboard, described as camera_calibration does: by its inner corners. The default is the
/// thesis' board.
struct Checkerboard {
  int columns = 8;          ///< inner corners in a row, at least 3
  int rows = 6;             ///< inner corners in a column, at least 3
  double square_m = 0.051;  ///< side of a square

  /// Corners row by row in the board's frame: origin in the middle of the inner corners, x along a row, y
  /// down the columns, z away from whoever looks at the print.
  std::vector<Eigen::Vector3d> corners() const;
};

/// Inner corners of the board in a CV_8UC1 image, in px from the centre of the upper left one, row by row in
/// the order of Checkerboard::corners(); nothing unless all are seen and form an even grid. Found by OpenCV's
/// detector (below 640 px of width at twice the size if need be) and refined by cornerSubPix within 0.35 of
/// the distance of the nearest neighbours: a window that reaches into the next square pulls the corner by up
/// to a pixel. A board that looks the same after half a turn is assumed to stand upright.
std::optional<std::vector<cv::Point2f>> findCorners(const cv::Mat& image, const Checkerboard& board);

/// One view of the board by both cameras, raw pixels, equal index = equal corner.
struct BoardCorners {
  std::vector<cv::Point2f> left;   ///< corners in the left image, px
  std::vector<cv::Point2f> right;  ///< corners in the right image, px
};

/// The corners in both images, in the same order; nothing unless both show the whole board. Throws
/// std::invalid_argument for a board of less than 3x3 corners or images that are not CV_8UC1.
std::optional<BoardCorners> findCorners(const cv::Mat& left, const cv::Mat& right, const Checkerboard& board);

}  // namespace stereo_nav::calibration
