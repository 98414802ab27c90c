#pragma once

#include "stereo_nav/sensors/imu/attitude_filter.h"

namespace stereo_nav::imu {

/// Explicit complementary filter with bias correction: Mahony, Hamel, Pflimlin, "Nonlinear complementary
/// filters on the special orthogonal group", IEEE TAC 53(5), 2008, equations (32) to (34), in quaternion form
/// (its appendix). Departure: the magnetometer's correction is projected on the vertical, so that iron nearby
/// turns the heading but never tilts the horizon.
class MahonyFilter : public AttitudeFilter {
 public:
  using AttitudeFilter::AttitudeFilter;

 private:
  void step(const Eigen::Vector3d& angular_velocity, const Directions& measured, double dt_s) override;
  Eigen::Vector3d correction(const Directions& measured) const;
};

}  // namespace stereo_nav::imu
