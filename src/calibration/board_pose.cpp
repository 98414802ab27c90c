#include "stereo_nav/calibration/board_pose.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>

#include "core/gauss_newton.h"
#include "vision/reprojection.h"

namespace stereo_nav::calibration {
namespace {

/// The pose of the board from its triangulated corners.
std::optional<Eigen::Isometry3d> alignTriangulated(const vision::StereoCalibration& calibration,
                                                   const std::vector<Eigen::Vector3d>& corners,
                                                   const std::vector<Eigen::Vector2d>& left,
                                                   const std::vector<Eigen::Vector2d>& right) {
  Eigen::Matrix3Xd board(3, corners.size()), camera(3, corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double disparity_px = left[i].x() - calibration.cx - (right[i].x() - calibration.right_cx);
    if (disparity_px <= 0.0) return std::nullopt;
    const auto column = static_cast<Eigen::Index>(i);
    board.col(column) = corners[i];
    camera.col(column) = calibration.backProject(left[i].x(), left[i].y(), disparity_px);
  }
  return Eigen::Isometry3d(Eigen::umeyama(board, camera, false));
}

}  // namespace

std::optional<BoardPose> estimateBoardPose(const vision::StereoCalibration& calibration,
                                           const Checkerboard& board,
                                           const std::vector<Eigen::Vector2d>& left_rect_px,
                                           const std::vector<Eigen::Vector2d>& right_rect_px) {
  const std::vector<Eigen::Vector3d> corners = board.corners();
  const auto start = alignTriangulated(calibration, corners, left_rect_px, right_rect_px);
  if (!start) return std::nullopt;
  vision::StereoView view;
  view.T_camera_world = *start;
  BoardPose pose;
  constexpr int kIterations = 10;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Matrix6d information = Matrix6d::Zero();
    Vector6d gradient = Vector6d::Zero();
    double squares = 0.0;
    pose.residual_px.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      vision::StereoObservation seen;
      seen.left_px = left_rect_px[i];
      seen.right_px = right_rect_px[i];
      seen.has_right = true;
      vision::ViewResidual residual;
      if (!vision::viewResidual(calibration, view, corners[i], seen, residual)) return std::nullopt;
      information += residual.by_pose.transpose() * residual.by_pose;
      gradient += residual.by_pose.transpose() * residual.error_px;
      squares += residual.error_px.squaredNorm();
      pose.residual_px.push_back(residual.error_px);
    }
    const auto step = gaussNewtonStep(information, gradient);
    if (!step) return std::nullopt;
    const auto freedom = static_cast<double>(4 * corners.size() - 6);
    pose.T_camera_board = view.T_camera_world;
    pose.covariance = squares / freedom * information.inverse();
    view.T_camera_world = renormalised(expMotion(*step) * view.T_camera_world);
  }
  if (!pose.T_camera_board.matrix().allFinite()) return std::nullopt;
  return pose;
}

BoardAngles boardAngles(const Eigen::Matrix3d& R) {
  return {std::atan2(R(0, 2), R(2, 2)), std::asin(std::clamp(-R(1, 2), -1.0, 1.0)),
          std::atan2(R(1, 0), R(1, 1))};
}

double lensError_px(const CameraModel& camera, const Checkerboard& board,
                    const std::vector<cv::Point2f>& raw_px) {
  std::vector<cv::Point3d> corners;
  for (const Eigen::Vector3d& corner : board.corners()) corners.emplace_back(corner.x(), corner.y(), 0.0);
  const std::vector<cv::Point2d> seen(raw_px.begin(), raw_px.end());
  // OpenCV knows no equidistant lens here: the pose is then found from rays, scaled to pixels.
  std::vector<cv::Point2d> straight = seen;
  if (camera.equidistant) {
    straight = camera.rays(seen);
    for (cv::Point2d& ray : straight)
      ray = {camera.K(0, 0) * ray.x + camera.K(0, 2), camera.K(1, 1) * ray.y + camera.K(1, 2)};
  }
  cv::Vec3d rotation, translation;
  if (!cv::solvePnP(corners, straight, camera.K, camera.equidistant ? cv::Mat() : camera.D, rotation,
                    translation)) {
    return std::numeric_limits<double>::infinity();
  }
  std::vector<cv::Point2d> predicted;
  if (camera.equidistant) {
    cv::fisheye::projectPoints(corners, predicted, rotation, translation, camera.K, camera.D);
  } else {
    cv::projectPoints(corners, rotation, translation, camera.K, camera.D, predicted);
  }
  return cv::norm(predicted, seen) / std::sqrt(static_cast<double>(seen.size()));
}

}  // namespace stereo_nav::calibration
