#include "sim/camera.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <stdexcept>

namespace stereo_nav::sim {
namespace {

struct Distorted {
  Eigen::Vector2d ray;
  Eigen::Matrix2d jacobian;
};

/// Brown's model as in OpenCV: radial k1, k2, k3 and tangential p1, p2.
Distorted plumbBob(const std::array<double, 5>& D, const Eigen::Vector2d& ray) {
  const auto& [k1, k2, p1, p2, k3] = D;
  const double x = ray.x(), y = ray.y(), r2 = ray.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = k1 + r2 * (2.0 * k2 + 3.0 * k3 * r2);  // d radial / d r2
  Distorted result;
  result.ray = {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
                y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
  const double cross = 2.0 * x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y;
  result.jacobian << radial + 2.0 * x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x, cross, cross,
      radial + 2.0 * y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
  return result;
}

template <int Rows, int Columns>
Eigen::Matrix<double, Rows, Columns> readMatrix(const YAML::Node& file, const char* key) {
  const auto values = file[key]["data"].as<std::vector<double>>();
  if (values.size() != Rows * Columns) throw std::runtime_error(std::string(key) + " has the wrong size");
  return Eigen::Map<const Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>>(values.data());
}

}  // namespace

Eigen::Vector2d CameraCalibration::distort(const Eigen::Vector2d& ray) const {
  const Eigen::Vector2d bent = plumbBob(D, ray).ray;
  return (K * bent.homogeneous()).head<2>();
}

Eigen::Vector2d CameraCalibration::undistort(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d bent = (K.inverse() * pixel.homogeneous()).head<2>();
  Eigen::Vector2d ray = bent;
  for (int iteration = 0; iteration < 50; ++iteration) {
    const Distorted guess = plumbBob(D, ray);
    const Eigen::Vector2d step = guess.jacobian.inverse() * (bent - guess.ray);
    ray += step;
    if (step.norm() < 1e-12) return ray;
  }
  throw std::runtime_error("calibration " + name + ": the distortion has no inverse at pixel (" +
                           std::to_string(pixel.x()) + ", " + std::to_string(pixel.y()) +
                           "); the coefficients do not fit the image size, calibrate again");
}

CameraCalibration loadCameraCalibration(const std::string& path) {
  try {
    const YAML::Node file = YAML::LoadFile(path);
    if (file["distortion_model"].as<std::string>() != "plumb_bob") {
      throw std::runtime_error("distortion_model must be plumb_bob");
    }
    CameraCalibration calibration;
    calibration.name = file["camera_name"].as<std::string>("camera");
    calibration.width = file["image_width"].as<int>();
    calibration.height = file["image_height"].as<int>();
    calibration.K = readMatrix<3, 3>(file, "camera_matrix");
    calibration.R = readMatrix<3, 3>(file, "rectification_matrix");
    calibration.P = readMatrix<3, 4>(file, "projection_matrix");
    const Eigen::Matrix<double, 1, 5> D = readMatrix<1, 5>(file, "distortion_coefficients");
    std::copy(D.data(), D.data() + 5, calibration.D.begin());
    return calibration;
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": not a usable camera calibration: " + error.what() +
                             "; it must be a file as camera_calibration writes it (ost.yaml)");
  }
}

StereoCalibrationPair loadStereoCalibration(const std::string& folder) {
  return {loadCameraCalibration(folder + "/left.yaml"), loadCameraCalibration(folder + "/right.yaml")};
}

CameraCalibration scaled(const CameraCalibration& calibration, double factor) {
  CameraCalibration result = calibration;
  result.width = static_cast<int>(std::lround(factor * calibration.width));
  result.height = static_cast<int>(std::lround(factor * calibration.height));
  for (int row = 0; row < 2; ++row) {
    // Pixel centres: x_new + 0.5 = factor * (x + 0.5).
    result.K.row(row) *= factor;
    result.K(row, 2) += 0.5 * (factor - 1.0);
    result.P.row(row) *= factor;
    result.P(row, 2) += 0.5 * (factor - 1.0);
  }
  return result;
}

}  // namespace stereo_nav::sim
