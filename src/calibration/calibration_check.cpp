#include "stereo_nav/calibration/calibration_check.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "core/statistics.h"

namespace stereo_nav::calibration {
namespace {

double square(double value) {
  return value * value;
}

/// Length of all rows and columns of the triangulated board, divided by that of the true one.
double boardScale(const vision::StereoCalibration& c, const Checkerboard& board,
                  const std::vector<Eigen::Vector2d>& left, const std::vector<Eigen::Vector2d>& right) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < left.size(); ++i) {
    points.push_back(c.backProject(left[i].x(), left[i].y(), left[i].x() - c.cx - right[i].x() + c.right_cx));
  }
  const auto at = [&](int row, int column) -> const Eigen::Vector3d& {
    return points[static_cast<std::size_t>(row * board.columns + column)];
  };
  double seen_m = 0.0, true_m = 0.0;
  for (int row = 0; row < board.rows; ++row) {
    seen_m += (at(row, board.columns - 1) - at(row, 0)).norm();
    true_m += (board.columns - 1) * board.square_m;
  }
  for (int column = 0; column < board.columns; ++column) {
    seen_m += (at(board.rows - 1, column) - at(0, column)).norm();
    true_m += (board.rows - 1) * board.square_m;
  }
  return seen_m / true_m;
}

/// RMS of a figure over the views, which all have the same number of corners.
double rms(const std::vector<ViewFigures>& views, double ViewFigures::*figure) {
  double squares = 0.0;
  for (const ViewFigures& view : views) squares += square(view.*figure);
  return std::sqrt(squares / static_cast<double>(views.size()));
}

double medianScale(const std::vector<ViewFigures>& views) {
  std::vector<double> scales;
  for (const ViewFigures& view : views) scales.push_back(view.scale);
  return quantile(std::move(scales), 0.5);
}

constexpr int kPartsX = 4, kPartsY = 3;

double seenShare(const cv::Size& size, const std::vector<BoardCorners>& corners) {
  std::set<int> seen;
  for (const BoardCorners& view : corners) {
    for (const cv::Point2f& corner : view.left) {
      const int x =
          std::clamp(static_cast<int>(kPartsX * corner.x / static_cast<float>(size.width)), 0, kPartsX - 1);
      const int y =
          std::clamp(static_cast<int>(kPartsY * corner.y / static_cast<float>(size.height)), 0, kPartsY - 1);
      seen.insert(y * kPartsX + x);
    }
  }
  return static_cast<double>(seen.size()) / (kPartsX * kPartsY);
}

std::vector<Criterion> criteriaOf(const CalibrationCheck& check, const CheckLimits& limits) {
  const std::string lens_remedy =
      "the lens model does not fit: calibrate again with the board in every corner of the image, near and "
      "far, tilted, and a flat board; was the focus moved or the image size changed since?";
  const bool shifted = std::abs(check.epipolar_mean_px) > 0.7 * check.epipolar_rms_px;
  const std::string rows_remedy =
      shifted
          ? "the rows of the two images are shifted against each other: the cameras have moved since the "
            "calibration; fasten them and calibrate again"
          : "hold the board still, since two free-running cameras see a moving board at different times; if "
            "it was still, calibrate again with more views";
  return {{"lens, left", "px", check.left_lens_px, limits.lens_px, lens_remedy},
          {"lens, right", "px", check.right_lens_px, limits.lens_px, lens_remedy},
          {"reprojection", "px", check.reprojection_px, limits.reprojection_px,
           "lenses and rows each may be good, but the two cameras do not agree on where the board is: " +
               rows_remedy},
          {"epipolar", "px", check.epipolar_rms_px, limits.epipolar_px, rows_remedy},
          {"disparity", "px", check.disparity_rms_px, limits.disparity_px,
           "depth over the board is not plane: hold it still, check that it is flat, or calibrate again"},
          {"scale", "%", 100.0 * check.scale_error, 100.0 * limits.scale,
           "distances are wrong by this much: measure a square of the board (--square), then calibrate again "
           "with it"}};
}

std::vector<std::string> notesOf(const CalibrationCheck& check) {
  std::vector<std::string> notes;
  constexpr std::size_t kFewViews = 5;
  if (check.views.size() < kFewViews) {
    notes.push_back("only " + std::to_string(check.views.size()) +
                    " views: take some 20, near and far and all over the image");
  }
  if (check.seen_share < 0.75) {
    notes.push_back("the board was in " + std::to_string(std::lround(100.0 * check.seen_share)) +
                    " % of the image only; nothing is known about the rest");
  }
  for (const ViewFigures& view : check.views) {
    const double worst_px = std::max(view.left_lens_px, view.right_lens_px);
    if (worst_px > 3.0 * std::max(check.left_lens_px, check.right_lens_px)) {
      notes.push_back(view.name + " fits far worse than the others: blurred, or a corner was mistaken");
    }
  }
  return notes;
}

}  // namespace

ViewFigures measureView(const StereoRig& rig, const Checkerboard& board, const std::string& name,
                        const BoardCorners& corners) {
  const auto count = static_cast<std::size_t>(board.columns * board.rows);
  if (corners.left.size() != count || corners.right.size() != count) {
    throw std::invalid_argument(name + ": " + std::to_string(count) + " corners are needed in both images");
  }
  const auto left = rig.left.rectify(corners.left), right = rig.right.rectify(corners.right);
  const auto pose = estimateBoardPose(rig.rectified, board, left, right);
  if (!pose) {
    throw std::runtime_error(
        name +
        ": the board would be behind the cameras; are left and right swapped, or is the calibration that of "
        "other cameras?");
  }
  ViewFigures view{name, *pose, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  view.left_lens_px = lensError_px(rig.left, board, corners.left);
  view.right_lens_px = lensError_px(rig.right, board, corners.right);
  view.scale = boardScale(rig.rectified, board, left, right);
  const auto n = static_cast<double>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double row_px = left[i].y() - right[i].y();
    view.epipolar_mean_px += row_px / n;
    view.epipolar_rms_px += square(row_px) / n;
    view.disparity_rms_px += square(pose->residual_px[i](0) - pose->residual_px[i](2)) / n;
  }
  view.epipolar_rms_px = std::sqrt(view.epipolar_rms_px);
  view.disparity_rms_px = std::sqrt(view.disparity_rms_px);
  return view;
}

CalibrationCheck checkCalibration(const StereoRig& rig, const std::vector<ViewFigures>& views,
                                  const std::vector<BoardCorners>& corners, const CheckLimits& limits) {
  CalibrationCheck check;
  check.views = views;
  check.left_lens_px = rms(views, &ViewFigures::left_lens_px);
  check.right_lens_px = rms(views, &ViewFigures::right_lens_px);
  check.epipolar_rms_px = rms(views, &ViewFigures::epipolar_rms_px);
  check.disparity_rms_px = rms(views, &ViewFigures::disparity_rms_px);
  check.epipolar_mean_px = check.reprojection_px = 0.0;
  std::size_t images_of_corners = 0;
  for (const ViewFigures& view : views) {
    check.epipolar_mean_px += view.epipolar_mean_px / static_cast<double>(views.size());
    for (const Eigen::Vector4d& residual : view.pose.residual_px)
      check.reprojection_px += residual.squaredNorm();
    images_of_corners += 2 * view.pose.residual_px.size();
  }
  check.reprojection_px = std::sqrt(check.reprojection_px / static_cast<double>(images_of_corners));
  check.scale_error = medianScale(views) - 1.0;
  check.seen_share = seenShare(rig.left.size, corners);
  check.criteria = criteriaOf(check, limits);
  check.notes = notesOf(check);
  return check;
}

bool CalibrationCheck::good() const {
  return std::all_of(criteria.begin(), criteria.end(), [](const Criterion& one) { return one.met(); });
}

double CalibrationCheck::depthNoise_m(const vision::StereoCalibration& calibration, double depth_m) const {
  return square(depth_m) * disparity_rms_px / (calibration.fx * calibration.baseline_m);
}

}  // namespace stereo_nav::calibration
