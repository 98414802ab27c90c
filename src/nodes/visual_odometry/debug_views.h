#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include <opencv2/core.hpp>
#include <vector>

#include "stereo_nav/odometry/common/odometry.h"

namespace stereo_nav::nodes {

/// Left image in which each feature has the colour of its result and a line from its previous position: green
/// inlier, red rejected, blue without depth, white newly detected. CV_8UC3, BGR.
cv::Mat drawFeatures(const cv::Mat& left, const odometry::FrameResult& result);

/// Features of known depth: x, y, z (left optical frame, m), rgb (the colours of drawFeatures) and id.
sensor_msgs::PointCloud2 featureCloud(const std_msgs::Header& header,
                                      const std::vector<odometry::FeatureReport>& features);

/// Disparity in colours: near is red, far is blue, unknown is black. CV_8UC3, BGR.
cv::Mat colourDisparity(const cv::Mat& disparity_px);

}  // namespace stereo_nav::nodes
