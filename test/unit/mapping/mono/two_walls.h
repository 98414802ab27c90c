#pragma once

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "mapping/mono/mono_camera.h"

namespace stereo_nav::mapping::test {

/// A textured wall 5 m before the origin and, before its right half, another one at 2.5 m. Axes of an optical
/// frame. An image takes a millisecond.
class TwoWalls {
 public:
  TwoWalls() : back_{texture(1), 5.0, 0.01, {-6.0, -6.0}}, front_{texture(2), 2.5, 0.005, {0.3, -3.0}} {}

  /// Of a pinhole camera, CV_8UC1.
  cv::Mat render(const MonoCamera& camera, const Eigen::Isometry3d& T_world_camera) const {
    cv::Mat image, near, mask;
    warp(back_, camera, T_world_camera, back_.texture, image);
    warp(front_, camera, T_world_camera, front_.texture, near);
    warp(front_, camera, T_world_camera, cv::Mat(front_.texture.size(), CV_8UC1, cv::Scalar(255)), mask);
    near.copyTo(image, mask == 255);
    cv::GaussianBlur(image, image, cv::Size(3, 3), 0.6);
    return image;
  }

  /// Distance from the origin to the wall it hits, in lengths of a direction with z = 1.
  double depth(const Eigen::Vector3d& direction) const {
    return front_.depth_m * direction.x() > front_.corner_m.x() ? front_.depth_m : back_.depth_m;
  }

 private:
  struct Wall {
    cv::Mat texture;
    double depth_m;
    double texel_m;
    Eigen::Vector2d corner_m;  ///< of the texture
  };

  static cv::Mat texture(int seed) {
    constexpr int kSide = 1200;
    cv::RNG random(static_cast<std::uint64_t>(seed));
    cv::Mat sum = cv::Mat::zeros(kSide, kSide, CV_32FC1);
    for (const int cells : {30, 75, 150}) {
      cv::Mat coarse(cells, cells, CV_32FC1), fine;
      random.fill(coarse, cv::RNG::UNIFORM, 0.0, 80.0);
      cv::resize(coarse, fine, sum.size(), 0.0, 0.0, cv::INTER_NEAREST);
      sum += fine;
    }
    cv::Mat grey;
    sum.convertTo(grey, CV_8UC1);
    return grey;
  }

  static void warp(const Wall& wall, const MonoCamera& camera, const Eigen::Isometry3d& T_world_camera,
                   const cv::Mat& texture, cv::Mat& out) {
    const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
    Eigen::Matrix3d K;
    K << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
    Eigen::Matrix3d H;
    H.col(0) = T_camera_world.linear().col(0) * wall.texel_m;
    H.col(1) = T_camera_world.linear().col(1) * wall.texel_m;
    H.col(2) = T_camera_world * Eigen::Vector3d(wall.corner_m.x(), wall.corner_m.y(), wall.depth_m);
    H = K * H;
    const cv::Matx33d image_from_texture(H(0, 0), H(0, 1), H(0, 2), H(1, 0), H(1, 1), H(1, 2), H(2, 0),
                                         H(2, 1), H(2, 2));
    cv::warpPerspective(texture, out, image_from_texture, camera.size, cv::INTER_AREA);
  }

  Wall back_, front_;
};

}  // namespace stereo_nav::mapping::test
