#include "sim/calibration_error.h"

#include <cmath>

#include "sim/random.h"
#include "stereo_nav/core/lie.h"

namespace stereo_nav::sim {
namespace {

/// Coefficients that are drawn: k1, k2, p1, p2.
constexpr std::size_t kDrawnCoefficients = 4;

/// RMS over the image of the pixels by which a unit of a distortion coefficient moves what is seen.
double effect_px(const CameraCalibration& calibration, std::size_t coefficient) {
  constexpr int kColumns = 16, kRows = 12;
  constexpr double kUnit = 1e-4;
  CameraCalibration bent = calibration;
  bent.D[coefficient] += kUnit;
  double sum_px2 = 0.0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Eigen::Vector2d pixel((column + 0.5) * calibration.width / kColumns,
                                  (row + 0.5) * calibration.height / kRows);
      sum_px2 += (bent.distort(calibration.undistort(pixel)) - pixel).squaredNorm();
    }
  }
  return std::sqrt(sum_px2 / (kColumns * kRows)) / kUnit;
}

void bend(double sigma_px, RandomStream& random, CameraCalibration& calibration) {
  const CameraCalibration nominal = calibration;
  const double each_px = sigma_px / std::sqrt(static_cast<double>(kDrawnCoefficients));
  for (std::size_t i = 0; i < kDrawnCoefficients; ++i)
    calibration.D[i] += each_px / effect_px(nominal, i) * random.normal();
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
  right.K(0, 2) += params.scale * params.column_offset_px * random.normal();
  const double focal = 1.0 + params.scale * params.focal_share * random.normal();
  for (CameraCalibration* camera : {&left, &right}) {
    bend(params.scale * params.distortion_px, random, *camera);
    camera->K(0, 0) *= focal;
    camera->K(1, 1) *= focal;
  }
  const Eigen::Vector3d turn(random.normal(), random.normal(), random.normal());
  cameras.T_nominal_true.linear() = expRotation(params.scale * params.mounting_rad * turn);
  return cameras;
}

}  // namespace stereo_nav::sim
