#include "nodes/visual_odometry/debug_views.h"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <opencv2/imgproc.hpp>

namespace stereo_nav::nodes {
namespace {

cv::Scalar colourOf(odometry::FeatureReport::Fate fate) {
  switch (fate) {
    case odometry::FeatureReport::Fate::kInlier:
      return {0, 220, 0};
    case odometry::FeatureReport::Fate::kRejected:
      return {0, 0, 230};
    case odometry::FeatureReport::Fate::kNoDepth:
      return {230, 120, 0};
    case odometry::FeatureReport::Fate::kDetected:
      break;
  }
  return {255, 255, 255};
}

bool hasDepth(const odometry::FeatureReport& feature) {
  return feature.p_camera.z() > 0.0;
}

}  // namespace

cv::Mat drawFeatures(const cv::Mat& left, const odometry::FrameResult& result) {
  cv::Mat view;
  cv::cvtColor(left, view, cv::COLOR_GRAY2BGR);
  constexpr int kRadius_px = 3;
  for (const odometry::FeatureReport& feature : result.features) {
    const cv::Scalar colour = colourOf(feature.fate);
    cv::line(view, feature.previous_px, feature.current_px, colour, 1, cv::LINE_AA);
    cv::circle(view, feature.current_px, kRadius_px, colour, 1, cv::LINE_AA);
  }
  return view;
}

sensor_msgs::PointCloud2 featureCloud(const std_msgs::Header& header,
                                      const std::vector<odometry::FeatureReport>& features) {
  std::size_t count = 0;
  for (const odometry::FeatureReport& feature : features) count += hasDepth(feature) ? 1 : 0;

  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  using sensor_msgs::PointField;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(5, "x", 1, PointField::FLOAT32, "y", 1, PointField::FLOAT32, "z", 1,
                                PointField::FLOAT32, "rgb", 1, PointField::FLOAT32, "id", 1,
                                PointField::UINT32);
  modifier.resize(count);
  sensor_msgs::PointCloud2Iterator<float> point(cloud, "x");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> bgr(cloud, "rgb");
  sensor_msgs::PointCloud2Iterator<std::uint32_t> id(cloud, "id");
  for (const odometry::FeatureReport& feature : features) {
    if (!hasDepth(feature)) continue;
    const cv::Scalar colour = colourOf(feature.fate);
    for (int axis = 0; axis < 3; ++axis) point[axis] = static_cast<float>(feature.p_camera[axis]);
    for (int channel = 0; channel < 3; ++channel) bgr[channel] = static_cast<std::uint8_t>(colour[channel]);
    *id = static_cast<std::uint32_t>(feature.id);
    ++point;
    ++bgr;
    ++id;
  }
  return cloud;
}

cv::Mat colourDisparity(const cv::Mat& disparity_px) {
  double largest = 0.0;
  cv::minMaxLoc(disparity_px, nullptr, &largest);
  cv::Mat scaled;
  disparity_px.convertTo(scaled, CV_8U, largest > 0.0 ? 255.0 / largest : 0.0);
  cv::Mat view;
  cv::applyColorMap(scaled, view, cv::COLORMAP_JET);
  view.setTo(cv::Scalar::all(0), disparity_px <= 0.0F);
  return view;
}

}  // namespace stereo_nav::nodes
