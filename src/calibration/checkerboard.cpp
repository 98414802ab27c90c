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

/// From the first to the last corner of the first row, and of the first column.
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

/// The detector may begin at any corner of the board: rows to the right, columns downwards, not mirrored.
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
  const cv::Size size(board.columns, board.rows);
  constexpr int kFlags = cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE;
  Corners corners;
  if (!cv::findChessboardCorners(image, size, corners, kFlags)) {
    cv::Mat larger;
    cv::resize(image, larger, cv::Size(), 2.0, 2.0, cv::INTER_LINEAR);
    if (!cv::findChessboardCorners(larger, size, corners, kFlags)) return std::nullopt;
    for (cv::Point2f& corner : corners) corner = 0.5f * (corner - cv::Point2f(0.5f, 0.5f));
  }
  const int window = std::clamp(static_cast<int>(0.35 * nearestNeighbours_px(corners, board)), 2, 11);
  cv::cornerSubPix(image, corners, cv::Size(window, window), cv::Size(-1, -1),
                   {cv::TermCriteria::EPS + cv::TermCriteria::COUNT, 100, 0.001});
  standUpright(corners, board);
  return corners;
}

std::optional<BoardCorners> findCorners(const cv::Mat& left, const cv::Mat& right,
                                        const Checkerboard& board) {
  auto left_corners = findCorners(left, board);
  if (!left_corners) return std::nullopt;
  auto right_corners = findCorners(right, board);
  if (!right_corners) return std::nullopt;
  // A board on its side is upright by chance.
  if (alongRow(*left_corners, board).dot(alongRow(*right_corners, board)) < 0.0) {
    std::reverse(right_corners->begin(), right_corners->end());
  }
  return BoardCorners{*left_corners, *right_corners};
}

}  // namespace stereo_nav::calibration
