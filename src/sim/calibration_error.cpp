#include "sim/calibration_error.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <vector>

#include "sim/random.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::sim {
namespace {

/// Coefficients that are drawn: k1, k2, p1, p2.
constexpr std::size_t kDrawnCoefficients = 4;

/// Pixels all over the image, at equal distances.
std::vector<Eigen::Vector2d> pixelsOf(const CameraCalibration& calibration) {
  constexpr int kColumns = 16, kRows = 12;
  std::vector<Eigen::Vector2d> pixels;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column)
      pixels.emplace_back((column + 0.5) * calibration.width / kColumns,
                          (row + 0.5) * calibration.height / kRows);
  }
  return pixels;
}

/// Shifts and scales the image of `bent` so that it lies as near as possible to that of the nominal camera:
/// as a calibration would, and since principal point and focal length have errors of their own.
void refit(const CameraCalibration& nominal, CameraCalibration& bent) {
  const std::vector<Eigen::Vector2d> pixels = pixelsOf(nominal);
  for (int axis = 0; axis < 2; ++axis) {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& pixel : pixels) {
      const double seen = bent.distort(nominal.undistort(pixel))[axis];
      const Eigen::Vector2d by((seen - bent.K(axis, 2)) / bent.K(axis, axis), 1.0);
      information += by * by.transpose();
      gradient += by * (pixel[axis] - seen);
    }
    const Eigen::Vector2d step = information.ldlt().solve(gradient);
    bent.K(axis, axis) += step[0];
    bent.K(axis, 2) += step[1];
  }
}

/// RMS over the image of the pixels by which a unit of a distortion coefficient moves what is seen.
double effect_px(const CameraCalibration& nominal, std::size_t coefficient) {
  constexpr double kUnit = 1e-4;
  CameraCalibration bent = nominal;
  bent.D[coefficient] += kUnit;
  refit(nominal, bent);
  const std::vector<Eigen::Vector2d> pixels = pixelsOf(nominal);
  double sum_px2 = 0.0;
  for (const Eigen::Vector2d& pixel : pixels)
    sum_px2 += (bent.distort(nominal.undistort(pixel)) - pixel).squaredNorm();
  return std::sqrt(sum_px2 / static_cast<double>(pixels.size())) / kUnit;
}

void bend(double sigma_px, RandomStream& random, CameraCalibration& calibration) {
  const CameraCalibration nominal = calibration;
  const double each_px = sigma_px / std::sqrt(static_cast<double>(kDrawnCoefficients));
  for (std::size_t i = 0; i < kDrawnCoefficients; ++i)
    calibration.D[i] += each_px / effect_px(nominal, i) * random.normal();
  refit(nominal, calibration);
}

}  // namespace

void CalibrationErrorParams::describe(ParameterVisitor& visitor) {
  visitor.real("scale", scale, {0.0, 100.0}, "",
               "by how much of the standard deviations below the cameras differ from their calibration; 0: "
               "they are exactly as calibrated");
  visitor.real("baseline_share", baseline_share, {0.0, 1.0}, "",
               "of the distance between the cameras, as a share of it");
  visitor.real("column_offset_px", column_offset_px, {0.0, 100.0}, "px",
               "of the right camera's principal point against the left one's");
  visitor.real("focal_share", focal_share, {0.0, 1.0}, "",
               "of the focal length of both cameras, as a share of it");
  visitor.real("distortion_px", distortion_px, {0.0, 100.0}, "px",
               "of what the lens model leaves over, RMS over the image, each camera for itself");
  visitor.real("mounting_rad", mounting_rad, {0.0, 1.0}, "rad",
               "of the left camera's mounting, about each axis");
}

TrueCameras trueCameras(const CalibrationErrorParams& params, const StereoCalibrationPair& nominal,
                        std::uint64_t seed) {
  TrueCameras cameras;
  cameras.calibration = nominal;
  if (params.scale == 0.0) return cameras;
  RandomStream random(streamKey(seed, Stream::kCalibration));
  auto& [left, right] = cameras.calibration;
  right.P(0, 3) *= 1.0 + params.scale * params.baseline_share * random.normal();
  const double column_offset_px = params.scale * params.column_offset_px * random.normal();
  const double focal = 1.0 + params.scale * params.focal_share * random.normal();
  for (CameraCalibration* camera : {&left, &right}) {
    if (params.distortion_px > 0.0) bend(params.scale * params.distortion_px, random, *camera);
    camera->K(0, 0) *= focal;
    camera->K(1, 1) *= focal;
  }
  right.K(0, 2) += column_offset_px;
  const Eigen::Vector3d turn(random.normal(), random.normal(), random.normal());
  cameras.T_nominal_true.linear() = expRotation(params.scale * params.mounting_rad * turn);
  return cameras;
}

}  // namespace stereo_nav::sim
