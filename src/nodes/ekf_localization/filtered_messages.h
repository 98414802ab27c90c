#pragma once

#include <geometry_msgs/AccelWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>

#include "estimation/ekf/fusion_filter.h"
#include "estimation/ekf/fusion_params.h"

namespace stereo_nav::nodes {

/// odometry/filtered.
nav_msgs::Odometry toOdometry(const estimation::FusedEstimate& estimate,
                              const estimation::FusionParams& params);

/// accel/filtered; its covariance is not known to the message (all zero).
geometry_msgs::AccelWithCovarianceStamped toAcceleration(const estimation::FusedEstimate& estimate,
                                                         const estimation::FusionParams& params);

/// `parent` -> `child`, at the estimate's time and the offset that the parameters add.
geometry_msgs::TransformStamped toTransform(const Eigen::Isometry3d& T_parent_child,
                                            const std::string& parent, const std::string& child,
                                            double time_s);

}  // namespace stereo_nav::nodes
