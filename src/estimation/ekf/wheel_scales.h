#pragma once

#include <Eigen/Core>
#include <array>

namespace stereo_nav::estimation {

constexpr int kWheelScales = 6;

/// What is wrong with the motion that wheels tell, of which forward, left and turning are axes 0 to 2: true
/// motion = (I + A) times that of the wheels. Wheels of radii that are wrong alike make the diagonal; those
/// whose radii differ turn and drift the robot as it moves ahead.
using WheelScales = Eigen::Matrix<double, kWheelScales, 1>;

/// The place in A of each scale: row, the motion that is wrong, and column, the one that it grows with.
struct ScalePlace {
  int axis, of;
};
constexpr std::array<ScalePlace, kWheelScales> kScalePlaces = {
    {{0, 0}, {1, 1}, {2, 2}, {2, 0}, {2, 1}, {1, 0}}};

/// Axes of a planar motion as fields of a twist.
constexpr std::array<int, 3> kPlanarFields = {0, 1, 5};

/// A turn that grows with the way ahead or to the left.
constexpr bool isTurnByWay(ScalePlace place) {
  return place.axis == 2 && place.of != 2;
}

/// I + A.
inline Eigen::Matrix3d matrixOf(const WheelScales& scales) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  for (int i = 0; i < kWheelScales; ++i) {
    const ScalePlace place = kScalePlaces[static_cast<std::size_t>(i)];
    matrix(place.axis, place.of) += scales[i];
  }
  return matrix;
}

}  // namespace stereo_nav::estimation
