#include "mapping/mono/known_start.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <limits>
#include <opencv2/calib3d.hpp>

#include "core/gauss_newton.h"
#include "mapping/mono/pixel_prediction.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::mapping {
namespace {

constexpr std::size_t kLeastPoints = 4;
constexpr int kIterations = 15;

StateBlock blockOf(const KnownPoint& point) {
  StateBlock block;
  block.value.head<3>() = point.p_world;
  return block;
}

/// A first pose from rays, by OpenCV.
CameraState firstPose(const MonoCamera& camera, const std::vector<KnownPoint>& points) {
  std::vector<cv::Point3d> places;
  std::vector<cv::Point2d> rays;
  for (const KnownPoint& point : points) {
    const Eigen::Vector3d ray = camera.ray(point.px);
    places.emplace_back(point.p_world.x(), point.p_world.y(), point.p_world.z());
    rays.emplace_back(ray.x(), ray.y());
  }
  cv::Vec3d rotation, translation;
  const bool found = cv::solvePnP(places, rays, cv::Matx33d::eye(), cv::noArray(), rotation, translation,
                                  false, points.size() < 6 ? cv::SOLVEPNP_AP3P : cv::SOLVEPNP_ITERATIVE);
  if (!found) throw InputError("the known points determine no pose of the camera: do they lie on a line?");
  const Eigen::Quaterniond q_camera_world =
      expQuaternion(Eigen::Vector3d(rotation[0], rotation[1], rotation[2]));
  CameraState state;
  state.q_world_camera = q_camera_world.conjugate();
  state.p_world = -(state.q_world_camera * Eigen::Vector3d(translation[0], translation[1], translation[2]));
  return state;
}

}  // namespace

PoseWithCovariance knownStart(const MonoCamera& camera, const std::vector<KnownPoint>& points,
                              double pixel_sigma_px) {
  if (points.size() < kLeastPoints)
    throw InputError(
        fmt::format("{} known points are too few for a start, needed are {}", points.size(), kLeastPoints));
  CameraState state = firstPose(camera, points);
  Matrix6d information = Matrix6d::Zero();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    information.setZero();
    Vector6d gradient = Vector6d::Zero();
    for (const KnownPoint& point : points) {
      const auto expected = expectedPixel(camera, state, blockOf(point), 0.0);
      if (!expected)
        throw InputError("a known point lies behind the camera: are the points those of this image?");
      const Eigen::Matrix<double, 2, 6> J = expected->by_camera.leftCols<6>();
      information += J.transpose() * J;
      gradient -= J.transpose() * (point.px - expected->px);
    }
    const auto step = gaussNewtonStep(information, gradient);
    if (!step) throw InputError("the known points determine no pose of the camera: do they lie on a line?");
    state.p_world += step->head<3>();
    state.q_world_camera = (state.q_world_camera * expQuaternion(step->tail<3>())).normalized();
  }
  return {state.T_world_camera(), pixel_sigma_px * pixel_sigma_px * information.inverse()};
}

}  // namespace stereo_nav::mapping
