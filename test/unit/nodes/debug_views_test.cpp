#include "nodes/visual_odometry/debug_views.h"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>

namespace stereo_nav::nodes {
namespace {

using Fate = odometry::FeatureReport::Fate;

odometry::FeatureReport feature(Fate fate, float x, float y, double depth_m) {
  odometry::FeatureReport report;
  report.id = 7;
  report.fate = fate;
  report.current_px = report.previous_px = {x, y};
  if (depth_m > 0.0) report.p_camera = {0.5, -0.25, depth_m};
  return report;
}

TEST(DebugViews, FeaturesHaveTheColourOfTheirFate) {
  odometry::FrameResult result;
  result.features = {feature(Fate::kInlier, 20, 20, 2.0), feature(Fate::kRejected, 60, 20, 3.0)};
  const cv::Mat view = drawFeatures(cv::Mat(40, 80, CV_8UC1, cv::Scalar(100)), result);
  ASSERT_EQ(view.type(), CV_8UC3);
  EXPECT_GT(view.at<cv::Vec3b>(20, 23)[1], 150) << "green: inlier";
  EXPECT_GT(view.at<cv::Vec3b>(20, 63)[2], 150) << "red: rejected";
  EXPECT_EQ(view.at<cv::Vec3b>(5, 40), cv::Vec3b(100, 100, 100));
}

TEST(DebugViews, TheCloudHoldsWhatHasDepth) {
  const auto cloud = featureCloud(std_msgs::Header(),
                                  {feature(Fate::kInlier, 1, 1, 2.0), feature(Fate::kNoDepth, 2, 2, 0.0)});
  ASSERT_EQ(cloud.width * cloud.height, 1u);
  sensor_msgs::PointCloud2ConstIterator<float> point(cloud, "x");
  EXPECT_EQ(point[0], 0.5F);
  EXPECT_EQ(point[1], -0.25F);
  EXPECT_EQ(point[2], 2.0F);
  EXPECT_EQ(*sensor_msgs::PointCloud2ConstIterator<std::uint32_t>(cloud, "id"), 7u);
}

TEST(DebugViews, UnknownDisparityIsBlack) {
  cv::Mat disparity(2, 2, CV_32FC1, cv::Scalar(-1));
  disparity.at<float>(0, 0) = 30.0F;
  const cv::Mat view = colourDisparity(disparity);
  EXPECT_NE(view.at<cv::Vec3b>(0, 0), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(view.at<cv::Vec3b>(1, 1), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(cv::countNonZero(colourDisparity(cv::Mat(2, 2, CV_32FC1, cv::Scalar(-1))).reshape(1)), 0);
}

}  // namespace
}  // namespace stereo_nav::nodes
