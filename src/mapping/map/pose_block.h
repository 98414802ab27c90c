#pragma once

#include <ceres/version.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "mapping/map/pose_graph.h"
#include "stereo_nav/core/lie.h"

#if CERES_VERSION_MAJOR * 100 + CERES_VERSION_MINOR >= 201
#include <ceres/manifold.h>
#else
#include <ceres/local_parameterization.h>
#endif

namespace stereo_nav::mapping {

/// A pose as the numbers that Ceres changes: in the plane (x, y, angle), in space (x, y, z and a unit
/// quaternion x, y, z, w).
template <class Pose>
struct PoseBlock;

template <>
struct PoseBlock<Eigen::Isometry2d> {
  static constexpr int kSize = 3;
  static void write(const Eigen::Isometry2d& T, double* block) {
    Eigen::Map<Eigen::Vector3d>{block} << T.translation(), yawOf(T);
  }
  static Eigen::Isometry2d read(const double* block) {
    return Eigen::Translation2d(block[0], block[1]) * Eigen::Rotation2Dd(block[2]);
  }
};

template <>
struct PoseBlock<Eigen::Isometry3d> {
  static constexpr int kSize = 7;
  static void write(const Eigen::Isometry3d& T, double* block) {
    Eigen::Map<Eigen::Vector3d>{block} = T.translation();
    Eigen::Map<Eigen::Quaterniond>{block + 3} = Eigen::Quaterniond(T.linear()).normalized();
  }
  static Eigen::Isometry3d read(const double* block) {
    Eigen::Isometry3d T;
    T.linear() = Eigen::Map<const Eigen::Quaterniond>(block + 3).toRotationMatrix();
    T.translation() = Eigen::Map<const Eigen::Vector3d>(block);
    T.makeAffine();
    return T;
  }
};

/// How a pose in space moves: (t + dt, R exp(dr)), for Ceres before 2.1 and after. Cost functions write their
/// derivatives by (dt, dr) into the first six columns of the block and zero into the seventh, so that the
/// derivative of this motion is the identity (as VINS-Mono has it).
#if CERES_VERSION_MAJOR * 100 + CERES_VERSION_MINOR >= 201
class SpatialMotion : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool PlusJacobian(const double* /*x*/, double* jacobian) const override { return identity(jacobian); }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    const Eigen::Map<const Eigen::Quaterniond> q_y(y + 3), q_x(x + 3);
    Eigen::Map<Vector6d>{y_minus_x} << Eigen::Map<const Eigen::Vector3d>(y) -
                                           Eigen::Map<const Eigen::Vector3d>(x),
        logRotation(Eigen::Quaterniond(q_x.conjugate() * q_y));
    return true;
  }
  bool MinusJacobian(const double* /*x*/, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>>{jacobian}.setIdentity();
    return true;
  }
#else
class SpatialMotion : public ceres::LocalParameterization {
 public:
  int GlobalSize() const override { return 7; }
  int LocalSize() const override { return 6; }
  bool ComputeJacobian(const double* /*x*/, double* jacobian) const override { return identity(jacobian); }
#endif
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const Eigen::Map<const Eigen::Quaterniond> q(x + 3);
    const Eigen::Quaterniond turned = q * expQuaternion(Eigen::Map<const Eigen::Vector3d>(delta + 3));
    Eigen::Map<Eigen::Vector3d>{x_plus_delta} =
        Eigen::Map<const Eigen::Vector3d>(x) + Eigen::Map<const Eigen::Vector3d>(delta);
    Eigen::Map<Eigen::Quaterniond>{x_plus_delta + 3} = turned.normalized();
    return true;
  }

 private:
  static bool identity(double* jacobian) {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>{jacobian}.setIdentity();
    return true;
  }
};

}  // namespace stereo_nav::mapping
