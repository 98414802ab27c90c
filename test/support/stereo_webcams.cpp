#include "support/stereo_webcams.h"

#include <algorithm>
#include <fstream>
#include <opencv2/calib3d.hpp>

namespace stereo_nav::test {
namespace {

constexpr double kDegree = M_PI / 180.0;

template <int Rows, int Columns, class Matrix>
Eigen::Matrix<double, Rows, Columns> toEigen(const Matrix& matrix) {
  return Eigen::Map<const Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>>(matrix.val);
}

calibration::StereoRig rigOf(const calibration::CameraModel& left, const calibration::CameraModel& right) {
  calibration::StereoRig rig{left, right, {}};
  rig.rectified.fx = right.P(0, 0);
  rig.rectified.fy = right.P(1, 1);
  rig.rectified.cx = left.P(0, 2);
  rig.rectified.cy = right.P(1, 2);
  rig.rectified.right_cx = right.P(0, 2);
  rig.rectified.baseline_m = -right.P(0, 3) / right.P(0, 0);
  rig.rectified.width = left.size.width;
  rig.rectified.height = left.size.height;
  return rig;
}

}  // namespace

WebcamPair webcamPair(int width, double baseline_m) {
  const double f = 0.87 * width;
  const int height = 3 * width / 4;
  const cv::Size size(width, height);
  const cv::Matx33d K_left(f, 0, 0.49 * width, 0, 1.003 * f, 0.52 * height, 0, 0, 1);
  const cv::Matx33d K_right(1.01 * f, 0, 0.51 * width, 0, 1.012 * f, 0.49 * height, 0, 0, 1);
  const cv::Vec<double, 5> D_left(-0.21, 0.07, 0.001, -0.0008, 0.0),
      D_right(-0.19, 0.06, -0.0007, 0.0012, 0.0);
  const Eigen::Matrix3d turn = (Eigen::AngleAxisd(0.8 * kDegree, Eigen::Vector3d::UnitX()) *
                                Eigen::AngleAxisd(-1.0 * kDegree, Eigen::Vector3d::UnitY()) *
                                Eigen::AngleAxisd(0.6 * kDegree, Eigen::Vector3d::UnitZ()))
                                   .toRotationMatrix();
  cv::Matx33d R;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.val) = turn;
  const cv::Vec3d T(-baseline_m, 0.001, -0.0015);
  cv::Matx33d R_left, R_right;
  cv::Matx34d P_left, P_right;
  cv::Mat Q;
  cv::stereoRectify(K_left, D_left, K_right, D_right, size, R, T, R_left, R_right, P_left, P_right, Q,
                    cv::CALIB_ZERO_DISPARITY, 0.0, size);
  const auto camera = [&](const char* name, const cv::Matx33d& K, const cv::Vec<double, 5>& D,
                          const cv::Matx33d& R_rect, const cv::Matx34d& P) {
    sim::CameraCalibration calibration;
    calibration.name = name;
    calibration.width = size.width;
    calibration.height = size.height;
    calibration.K = toEigen<3, 3>(K);
    std::copy(D.val, D.val + 5, calibration.D.begin());
    calibration.R = toEigen<3, 3>(R_rect);
    calibration.P = toEigen<3, 4>(P);
    return calibration;
  };
  return {camera("left", K_left, D_left, R_left, P_left),
          camera("right", K_right, D_right, R_right, P_right)};
}

calibration::CameraModel toModel(const sim::CameraCalibration& c) {
  calibration::CameraModel model;
  model.size = cv::Size(c.width, c.height);
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(model.K.val) = c.K;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(model.R.val) = c.R;
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(model.P.val) = c.P;
  model.D = cv::Mat(1, 5, CV_64FC1);
  std::copy(c.D.begin(), c.D.end(), model.D.begin<double>());
  return model;
}

calibration::StereoRig toRig(const sim::CameraCalibration& left, const sim::CameraCalibration& right) {
  return rigOf(toModel(left), toModel(right));
}

void writeCalibration(const std::string& path, const std::string& name,
                      const calibration::CameraModel& camera) {
  std::ofstream file(path);
  file.precision(12);
  const auto matrix = [&](const char* key, int rows, int columns, const double* values) {
    file << key << ":\n  rows: " << rows << "\n  cols: " << columns << "\n  data: [";
    for (int i = 0; i < rows * columns; ++i) file << (i == 0 ? "" : ", ") << values[i];
    file << "]\n";
  };
  file << "image_width: " << camera.size.width << "\nimage_height: " << camera.size.height
       << "\ncamera_name: " << name << "\n";
  matrix("camera_matrix", 3, 3, camera.K.val);
  file << "distortion_model: plumb_bob\n";
  matrix("distortion_coefficients", 1, 5, camera.D.ptr<double>());
  matrix("rectification_matrix", 3, 3, camera.R.val);
  matrix("projection_matrix", 3, 4, camera.P.val);
}

calibration::StereoRig calibrateByOpenCv(const std::vector<calibration::BoardCorners>& views,
                                         const calibration::Checkerboard& board, cv::Size size,
                                         double* rms_px) {
  std::vector<cv::Point3f> corners;
  for (const Eigen::Vector3d& corner : board.corners()) {
    corners.emplace_back(static_cast<float>(corner.x()), static_cast<float>(corner.y()), 0.0f);
  }
  const std::vector<std::vector<cv::Point3f>> objects(views.size(), corners);
  std::vector<std::vector<cv::Point2f>> left, right;
  for (const auto& view : views) {
    left.push_back(view.left);
    right.push_back(view.right);
  }
  calibration::CameraModel models[2];
  cv::Mat K[2], D[2], rotations, translations, R, T, E, F, Q;
  cv::calibrateCamera(objects, left, size, K[0], D[0], rotations, translations, cv::CALIB_FIX_K3);
  cv::calibrateCamera(objects, right, size, K[1], D[1], rotations, translations, cv::CALIB_FIX_K3);
  const double rms = cv::stereoCalibrate(objects, left, right, K[0], D[0], K[1], D[1], size, R, T, E, F,
                                         cv::CALIB_FIX_INTRINSIC);
  if (rms_px != nullptr) *rms_px = rms;
  cv::stereoRectify(K[0], D[0], K[1], D[1], size, R, T, models[0].R, models[1].R, models[0].P, models[1].P, Q,
                    cv::CALIB_ZERO_DISPARITY, 0.0, size);
  for (int i = 0; i < 2; ++i) {
    models[i].size = size;
    models[i].K = cv::Matx33d(K[i]);
    models[i].D = D[i].reshape(1, 1);
  }
  return rigOf(models[0], models[1]);
}

}  // namespace stereo_nav::test
