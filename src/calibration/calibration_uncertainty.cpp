#include "calibration/calibration_uncertainty.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "vision/reprojection.h"

namespace stereo_nav::calibration {
namespace {

constexpr std::size_t kFewestViews = 5;
/// Larger standard deviations than these mean that the views do not tell: shares, and px.
constexpr double kTold_share = 0.01;
constexpr double kTold_px = 1.0;
/// Parts of an image, across and down, over which lens errors are taken as one.
constexpr int kLensPartsX = 5, kLensPartsY = 4;
constexpr int kFewestCorners = 20;  ///< of a part that tells something

using Projections = Eigen::Matrix<double, 4, 3>;  ///< derivatives by the three corrections

/// What a view says about the corrections (share of the baseline, columns in px, share of the focal length),
/// with its pose eliminated.
struct Share {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

/// Derivatives of left x, y, right x, y of a point.
Projections byCorrections(const vision::StereoCalibration& c, const Eigen::Vector3d& p) {
  const double x_px = c.fx * p.x() / p.z(), y_px = c.fy * p.y() / p.z();
  const double disparity_px = c.fx * c.baseline_m / p.z();
  Projections by;
  by << 0.0, 0.0, x_px,  //
      0.0, 0.0, y_px,    //
      -disparity_px, 1.0, x_px - disparity_px, 0.0, 0.0, y_px;
  return by;
}

Share shareOf(const vision::StereoCalibration& calibration, const Checkerboard& board,
              const ViewFigures& figures) {
  vision::StereoView view;
  view.T_camera_world = figures.pose.T_camera_board;
  vision::StereoObservation seen;  // the derivatives do not depend on where
  seen.has_right = true;
  Matrix6d poses = Matrix6d::Zero();
  Eigen::Matrix<double, 6, 3> mixed = Eigen::Matrix<double, 6, 3>::Zero();
  Vector6d by_poses = Vector6d::Zero();
  Share share;
  const std::vector<Eigen::Vector3d> corners = board.corners();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    vision::ViewResidual residual;
    if (!vision::viewResidual(calibration, view, corners[i], seen, residual)) return {};
    const Projections by = -byCorrections(calibration, view.T_camera_world * corners[i]);
    const Eigen::Vector4d& error_px = figures.pose.residual_px[i];
    poses += residual.by_pose.transpose() * residual.by_pose;
    mixed += residual.by_pose.transpose() * by;
    by_poses += residual.by_pose.transpose() * error_px;
    share.information += by.transpose() * by;
    share.gradient += by.transpose() * error_px;
  }
  const Eigen::LDLT<Matrix6d> solver(poses);
  share.information -= mixed.transpose() * solver.solve(mixed);
  share.gradient -= mixed.transpose() * solver.solve(by_poses);
  return share;
}

Eigen::Vector3d correction(const Share& share) {
  return -share.information.ldlt().solve(share.gradient);
}

/// Standard deviations of the corrections found, themselves included; infinite where nothing can be said.
Eigen::Vector3d correctionSigmas(const vision::StereoCalibration& calibration, const Checkerboard& board,
                                 const std::vector<ViewFigures>& views) {
  std::vector<Share> shares;
  Share all;
  for (const ViewFigures& view : views) {
    shares.push_back(shareOf(calibration, board, view));
    all.information += shares.back().information;
    all.gradient += shares.back().gradient;
  }
  const Eigen::Vector3d found = correction(all);
  const auto n = static_cast<double>(views.size());
  Eigen::Vector3d variance = Eigen::Vector3d::Zero();
  for (const Share& one : shares) {
    const Share others{all.information - one.information, all.gradient - one.gradient};
    variance += (n - 1.0) / n * (correction(others) - found).cwiseAbs2();
  }
  return (found.cwiseAbs2() + variance).cwiseSqrt();
}

std::optional<double> told(double sigma, double most) {
  if (!(sigma <= most)) return std::nullopt;
  return sigma;
}

/// RMS over parts of both images of the mean residuals.
std::optional<double> lensSigma_px(const StereoRig& rig, const Checkerboard& board,
                                   const std::vector<ViewFigures>& views) {
  struct Part {
    int count = 0;
    Eigen::Vector2d sum_px = Eigen::Vector2d::Zero();
    double sum_px2 = 0.0;
  };
  const vision::StereoCalibration& c = rig.rectified;
  const auto part = [](double px, int size, int parts) {
    return std::clamp(static_cast<int>(parts * px / size), 0, parts - 1);
  };
  std::map<std::pair<int, int>, Part> parts;  // by camera and place
  for (const ViewFigures& view : views) {
    const std::vector<Eigen::Vector3d> corners = board.corners();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector3d p = view.pose.T_camera_board * corners[i];
      const double column = c.fx * p.x() / p.z() + c.cx, row = c.fy * p.y() / p.z() + c.cy;
      const int place = kLensPartsX * part(row, c.height, kLensPartsY) + part(column, c.width, kLensPartsX);
      for (int camera = 0; camera < 2; ++camera) {
        const Eigen::Vector2d error_px = view.pose.residual_px[i].segment<2>(2 * camera);
        Part& one = parts[{camera, place}];
        ++one.count;
        one.sum_px += error_px;
        one.sum_px2 += error_px.squaredNorm();
      }
    }
  }
  double sum = 0.0;
  int told = 0;
  for (const auto& [place, one] : parts) {
    if (one.count < kFewestCorners) continue;
    const double mean_px2 = (one.sum_px / one.count).squaredNorm();
    const double noise_px2 = (one.sum_px2 / one.count - mean_px2) / (one.count - 1);
    sum += std::max(0.0, mean_px2 - noise_px2);
    ++told;
  }
  if (told == 0) return std::nullopt;
  return std::sqrt(sum / told);
}

}  // namespace

CalibrationUncertainty calibrationUncertainty(const StereoRig& rig, const Checkerboard& board,
                                              const std::vector<ViewFigures>& views) {
  if (views.size() < kFewestViews) return {};
  const Eigen::Vector3d sigmas = correctionSigmas(rig.rectified, board, views);
  return {told(sigmas[0], kTold_share), told(sigmas[1], kTold_px), told(sigmas[2], kTold_share),
          lensSigma_px(rig, board, views)};
}

}  // namespace stereo_nav::calibration
