#include "odometry/stereo/lens_error_fields.h"

#include <Eigen/Cholesky>
#include <vector>

namespace stereo_nav::odometry {
namespace {

using Shifts = LensErrorFields::Shifts;

/// Derivatives of the lens model by k1, p1, p2.
Shifts byCoefficients(const Eigen::Vector2d& ray) {
  const double x = ray.x(), y = ray.y(), squared = ray.squaredNorm();
  Shifts shifts;
  shifts << x * squared, 2.0 * x * y, squared + 2.0 * x * x,  //
      y * squared, squared + 2.0 * y * y, 2.0 * x * y;
  return shifts;
}

std::vector<Eigen::Vector2d> raysOf(const vision::StereoCalibration& calibration) {
  constexpr int kColumns = 16, kRows = 12;
  std::vector<Eigen::Vector2d> rays;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column)
      rays.emplace_back(((column + 0.5) * calibration.width / kColumns - calibration.cx) / calibration.fx,
                        ((row + 0.5) * calibration.height / kRows - calibration.cy) / calibration.fy);
  }
  return rays;
}

}  // namespace

LensErrorFields::LensErrorFields(const vision::StereoCalibration& calibration) {
  const std::vector<Eigen::Vector2d> rays = raysOf(calibration);
  for (int axis = 0; axis < 2; ++axis) {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Matrix<double, 2, kFields> gradient = Eigen::Matrix<double, 2, kFields>::Zero();
    for (const Eigen::Vector2d& ray : rays) {
      const Eigen::Vector2d by(ray[axis], 1.0);
      information += by * by.transpose();
      gradient += by * byCoefficients(ray).row(axis);
    }
    const Eigen::Matrix<double, 2, kFields> fit = information.ldlt().solve(gradient);
    scale_.row(axis) = fit.row(0);
    offset_.row(axis) = fit.row(1);
  }
  Eigen::Array<double, 1, kFields> squares = Eigen::Array<double, 1, kFields>::Zero();
  for (const Eigen::Vector2d& ray : rays) squares += at(ray).array().square().colwise().sum();
  const Eigen::Array<double, 1, kFields> shares(0.5, 0.25, 0.25);
  unit_ = (shares * static_cast<double>(rays.size()) / squares).sqrt();
}

LensErrorFields::Shifts LensErrorFields::at(const Eigen::Vector2d& ray) const {
  const Shifts rest = byCoefficients(ray) - ray.asDiagonal() * scale_ - offset_;
  return (rest.array().rowwise() * unit_).matrix();
}

}  // namespace stereo_nav::odometry
