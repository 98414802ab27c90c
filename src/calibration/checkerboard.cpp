#include "stereo_nav/calibration/checkerboard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace stereo_nav::calibration {
namespace {

using Corners = std::vector<cv::Point2f>;

std::size_t indexOf(const Checkerboard& board, int row, int column) {
  return static_cast<std::size_t>(row * board.columns + column);
}

/// Vectors from the first to the last corner of the first row, and of the first column.
cv::Point2f alongRow(const Corners& corners, const Checkerboard& board) {
  return corners[indexOf(board, 0, board.columns - 1)] - corners.front();
}
cv::Point2f alongColumn(const Corners& corners, const Checkerboard& board) {
  return corners[indexOf(board, board.rows - 1, 0)] - corners.front();
}

double nearestNeighbours_px(const Corners& corners, const Checkerboard& board) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      const cv::Point2f& corner = corners[indexOf(board, row, column)];
      if (column > 0)
        nearest = std::min(nearest, cv::norm(corner - corners[indexOf(board, row, column - 1)]));
      if (row > 0) nearest = std::min(nearest, cv::norm(corner - corners[indexOf(board, row - 1, column)]));
    }
  }
  return nearest;
}

/// OpenCV's detector in the image made `scale` times as large.
std::optional<Corners> detect(const cv::Mat& image, const Checkerboard& board, int scale) {
  cv::Mat larger = image;
  if (scale != 1) cv::resize(image, larger, cv::Size(), scale, scale, cv::INTER_LINEAR);
  Corners corners;
  if (!cv::findChessboardCorners(
          larger, cv::Size(board.columns, board.rows), corners,
          cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK))
    return std::nullopt;
  const auto factor = static_cast<float>(scale), centre = 0.5f * (factor - 1.0f);
  for (cv::Point2f& corner : corners) corner = (corner - cv::Point2f(centre, centre)) / factor;
  return corners;
}

/// Whether each corner lies about midway between its neighbours. Sometimes the detector mistakes something
/// else, a square away, for an outer corner.
bool isEven(const Corners& corners, const Checkerboard& board) {
  constexpr double kShare = 0.25;  // of a square; a slanted board near a wide lens comes to 0.1
  const auto midway = [](const cv::Point2f& before, const cv::Point2f& corner, const cv::Point2f& after) {
    return cv::norm(before - 2.0f * corner + after) < kShare * 0.5 * cv::norm(after - before);
  };
  for (int row = 0; row < board.rows; ++row) {
    for (int column = 0; column < board.columns; ++column) {
      const auto at = [&](int r, int c) { return corners[indexOf(board, r, c)]; };
      const bool inner_column =
          column > 0 && column<board.columns - 1, inner_row = row> 0 && row < board.rows - 1;
      if (inner_column && !midway(at(row, column - 1), at(row, column), at(row, column + 1))) return false;
      if (inner_row && !midway(at(row - 1, column), at(row, column), at(row + 1, column))) return false;
    }
  }
  return true;
}

/// Orders the corners: rows to the right, columns downwards, not mirrored. The detector may begin at any
/// corner of the board.
void standUpright(Corners& corners, const Checkerboard& board) {
  if (alongRow(corners, board).cross(alongColumn(corners, board)) < 0.0) {
    for (int row = 0; row < board.rows; ++row) {
      const auto begin = corners.begin() + row * board.columns;
      std::reverse(begin, begin + board.columns);
    }
  }
  if (alongRow(corners, board).x < 0.0f) std::reverse(corners.begin(), corners.end());
}

void check(const cv::Mat& image, const Checkerboard& board) {
  if (board.columns < 3 || board.rows < 3) {
    throw std::invalid_argument("a checkerboard has at least 3x3 inner corners, not " +
                                std::to_string(board.columns) + "x" + std::to_string(board.rows));
  }
  if (image.type() != CV_8UC1 || image.empty()) {
    throw std::invalid_argument("the checkerboard is looked for in grey images of 8 bits");
  }
}

}  // namespace

std::vector<Eigen::Vector3d> Checkerboard::corners() const {
  std::vector<Eigen::Vector3d> corners;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      corners.emplace_back((column - 0.5 * (columns - 1)) * square_m, (row - 0.5 * (rows - 1)) * square_m,
                           0.0);
    }
  }
  return corners;
}

std::optional<Corners> findCorners(const cv::Mat& image, const Checkerboard& board) {
  check(image, board);
  // The larger picture takes seconds where there is no board; webcams of 640x480 do without.
  const int largest_scale = image.cols < 640 ? 2 : 1;
  for (int scale = 1; scale <= largest_scale; ++scale) {
    auto corners = detect(image, board, scale);
    if (!corners) continue;
    const int window = std::clamp(static_cast<int>(0.35 * nearestNeighbours_px(*corners, board)), 2, 11);
    cv::cornerSubPix(image, *corners, cv::Size(window, window), cv::Size(-1, -1),
                     {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 100, 0.001});
    if (!isEven(*corners, board)) continue;
    standUpright(*corners, board);
    return corners;
  }
  return std::nullopt;
}

std::optional<BoardCorners> findCorners(const cv::Mat& left, const cv::Mat& right,
                                        const Checkerboard& board) {
  auto left_corners = findCorners(left, board);
  if (!left_corners) return std::nullopt;
  auto right_corners = findCorners(right, board);
  if (!right_corners) return std::nullopt;
  // Which way is up on a board that stands on its side is arbitrary.
  if (alongRow(*left_corners, board).dot(alongRow(*right_corners, board)) < 0.0) {
    std::reverse(right_corners->begin(), right_corners->end());
  }
  return BoardCorners{*left_corners, *right_corners};
}

}  // namespace stereo_nav::calibration
