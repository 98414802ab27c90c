#include "support/simulated_board.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "sim/image_sensor.h"

namespace stereo_nav::test {
namespace {

/// Rays of a pixel, no two in one column or row, so that edges along the rows are as smooth as slanted ones
/// (Hammersley's points).
constexpr int kRays = 16;
Eigen::Vector2d rayInPixel(int ray) {
  const int reversed = (ray & 1) << 3 | (ray & 2) << 1 | (ray & 4) >> 1 | (ray & 8) >> 3;
  return {(ray + 0.5) / kRays - 0.5, (reversed + 0.5) / kRays - 0.5};
}

constexpr float kWhite = 200.0f, kBlack = 35.0f, kWall = 120.0f;
constexpr double kDegree = M_PI / 180.0;

/// Grey level of a point of the board's plane: the squares, a white margin of one square, the wall behind.
float greyLevel(const calibration::Checkerboard& board, double x_m, double y_m) {
  const double column = x_m / board.square_m + 0.5 * (board.columns + 1);
  const double row = y_m / board.square_m + 0.5 * (board.rows + 1);
  if (column < 0.0 || row < 0.0 || column >= board.columns + 1 || row >= board.rows + 1) {
    const bool margin = column >= -1.0 && row >= -1.0 && column < board.columns + 2 && row < board.rows + 2;
    return margin ? kWhite : kWall;
  }
  return (static_cast<int>(column) + static_cast<int>(row)) % 2 == 0 ? kBlack : kWhite;
}

Eigen::Vector3d positionOf(const sim::CameraCalibration& calibration) {
  return {calibration.offsetX_m(), 0.0, 0.0};
}

}  // namespace

SimulatedBoard::SimulatedBoard(const sim::CameraCalibration& left, const sim::CameraCalibration& right,
                               const calibration::Checkerboard& board, const WebcamFaults& faults)
    : left_(makeEye(left)), right_(makeEye(right)), board_(board), faults_(faults) {}

SimulatedBoard::Eye SimulatedBoard::makeEye(const sim::CameraCalibration& calibration) {
  Eye eye{calibration, {}};
  for (int y = 0; y < calibration.height; ++y) {
    for (int x = 0; x < calibration.width; ++x) {
      for (int ray = 0; ray < kRays; ++ray) {
        const Eigen::Vector2d pixel = Eigen::Vector2d(x, y) + rayInPixel(ray);
        eye.rays.push_back(calibration.R * calibration.undistort(pixel).homogeneous());
      }
    }
  }
  return eye;
}

cv::Mat SimulatedBoard::draw(const Eye& eye, const Eigen::Isometry3d& T_camera_board, double gain,
                             std::uint64_t key) const {
  const Eigen::Isometry3d T_board_camera = T_camera_board.inverse();
  const Eigen::Vector3d origin = T_board_camera * positionOf(eye.calibration);
  cv::Mat light(eye.calibration.height, eye.calibration.width, CV_32FC1);
  auto ray = eye.rays.begin();
  for (int y = 0; y < light.rows; ++y) {
    for (int x = 0; x < light.cols; ++x) {
      float sum = 0.0f;
      for (int i = 0; i < kRays; ++i) {
        const Eigen::Vector3d direction = T_board_camera.linear() * *ray++;
        const double distance = -origin.z() / direction.z();
        sum +=
            greyLevel(board_, origin.x() + distance * direction.x(), origin.y() + distance * direction.y());
      }
      light.at<float>(y, x) = sum / kRays;
    }
  }
  cv::GaussianBlur(light, light, cv::Size(), faults_.blur_px * eye.calibration.width / 640.0);
  sim::SensorParams sensor;
  sensor.read_noise = faults_.read_noise;
  sensor.shot_noise = faults_.shot_noise;
  sim::CameraResponse response;
  response.gain = gain;
  return sim::ImageSensor(light.cols, light.rows, sensor, response).expose(light, key);
}

SimulatedBoard::Pair SimulatedBoard::draw(const Eigen::Isometry3d& T_camera_board, std::uint64_t seed) const {
  return {draw(left_, T_camera_board, 1.0, 2 * seed * 0x9E3779B97F4A7C15ull),
          draw(right_, T_camera_board, faults_.right_gain, (2 * seed + 1) * 0x9E3779B97F4A7C15ull)};
}

bool SimulatedBoard::inView(const Eye& eye, const Eigen::Isometry3d& T_camera_board) const {
  for (const Eigen::Vector3d& corner : board_.corners()) {
    // A square further out than the corners.
    const Eigen::Vector3d outer(corner.x() * (board_.columns + 1) / (board_.columns - 1),
                                corner.y() * (board_.rows + 1) / (board_.rows - 1), 0.0);
    const Eigen::Vector3d p =
        eye.calibration.R.transpose() * (T_camera_board * outer - positionOf(eye.calibration));
    if (p.z() < 0.05) return false;
    const Eigen::Vector2d pixel = eye.calibration.distort(p.hnormalized());
    if (pixel.x() < 0.0 || pixel.y() < 0.0 || pixel.x() > eye.calibration.width - 1 ||
        pixel.y() > eye.calibration.height - 1)
      return false;
  }
  return true;
}

bool SimulatedBoard::inView(const Eigen::Isometry3d& T_camera_board) const {
  return inView(left_, T_camera_board) && inView(right_, T_camera_board);
}

Eigen::Isometry3d boardAt(double x_m, double y_m, double z_m, double yaw_deg, double pitch_deg,
                          double roll_deg) {
  Eigen::Isometry3d T_camera_board = Eigen::Isometry3d::Identity();
  T_camera_board.translation() << x_m, y_m, z_m;
  T_camera_board.linear() = (Eigen::AngleAxisd(yaw_deg * kDegree, Eigen::Vector3d::UnitY()) *
                             Eigen::AngleAxisd(pitch_deg * kDegree, Eigen::Vector3d::UnitX()) *
                             Eigen::AngleAxisd(roll_deg * kDegree, Eigen::Vector3d::UnitZ()))
                                .toRotationMatrix();
  return T_camera_board;
}

}  // namespace stereo_nav::test
