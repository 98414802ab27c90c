#include "nodes/visual_odometry/odometry_publisher.h"

#include <cv_bridge/cv_bridge.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/image_encodings.h>
#include <tf2_eigen/tf2_eigen.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "core/angles.h"
#include "nodes/visual_odometry/debug_views.h"
#include "ros/keyframe_message.h"
#include "ros/pose_messages.h"

namespace stereo_nav::nodes {
namespace {

using odometry::State;
static_assert(static_cast<int>(State::kInitialising) == VoStatus::INITIALISING &&
                  static_cast<int>(State::kTracking) == VoStatus::TRACKING &&
                  static_cast<int>(State::kCoasting) == VoStatus::COASTING &&
                  static_cast<int>(State::kLost) == VoStatus::LOST,
              "VoStatus.state carries the value of odometry::State");

std::string reasonOf(const SessionOutput& output) {
  std::string reason = output.processed ? output.result.reason : "";
  for (const auto* problems : {&output.errors, &output.warnings}) {
    for (const auto& problem : *problems) reason += (reason.empty() ? "" : "; ") + problem.second;
  }
  for (const auto& announcement : output.announcements) reason += (reason.empty() ? "" : "; ") + announcement;
  return reason;
}

double distance(const geometry_msgs::Point& a, const geometry_msgs::Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

}  // namespace

OdometryPublisher::OdometryPublisher(ros::NodeHandle& handle, const VisualOdometryParams& params)
    : params_(params),
      odometry_publisher_(handle.advertise<nav_msgs::Odometry>("odom", 50)),
      path_publisher_(handle.advertise<nav_msgs::Path>("path", 1)),
      status_publisher_(handle.advertise<VoStatus>("vo/status", 50)),
      features_publisher_(handle.advertise<sensor_msgs::PointCloud2>("vo/features", 5)),
      keyframe_publisher_(handle.advertise<Keyframe>("vo/keyframe", 20)),
      image_transport_(handle),
      debug_publisher_(image_transport_.advertise("vo/debug_image", 2)) {
  path_.header.frame_id = params_.odom_frame;
}

void OdometryPublisher::publish(const ros_io::FrameMessages& frame, const SessionOutput& output,
                                const FrameCounts& counts) {
  if (output.processed) publishOdometry(frame, output.base);
  publishStatus(frame, output, counts);
  if (!output.processed) return;
  publishKeyframe(frame, output);
  publishViews(frame, output);
}

void OdometryPublisher::publishOdometry(const ros_io::FrameMessages& frame,
                                        const estimation::BaseEstimate& base) {
  auto odometry = boost::make_shared<nav_msgs::Odometry>();
  odometry->header.stamp = frame.left_stamp;
  odometry->header.frame_id = params_.odom_frame;
  odometry->child_frame_id = params_.base_frame;
  odometry->pose.pose = tf2::toMsg(base.T_odom_base);
  ros_io::fillCovariance(base.pose_covariance, odometry->pose.covariance);
  odometry->twist.twist = tf2::toMsg(base.twist);
  ros_io::fillCovariance(base.twist_covariance, odometry->twist.covariance);
  odometry_publisher_.publish(odometry);
  publishPath(odometry->header, odometry->pose.pose);

  if (params_.publish_tf) transform_publisher_.publish(*odometry);
}

void OdometryPublisher::publishPath(const std_msgs::Header& header, const geometry_msgs::Pose& pose) {
  auto& poses = path_.poses;
  // Poses are kept without a subscriber, too, so that later subscribers get the whole path.
  const bool is_new =
      poses.empty() || distance(poses.back().pose.position, pose.position) >= params_.path_spacing_m;
  if (is_new) {
    if (poses.size() >= static_cast<std::size_t>(params_.path_max_poses)) {
      for (std::size_t i = 0; 2 * i < poses.size(); ++i) poses[i] = poses[2 * i];
      poses.resize((poses.size() + 1) / 2);
    }
    poses.emplace_back();
    poses.back().header = header;
    poses.back().pose = pose;
  }
  if (!is_new || path_publisher_.getNumSubscribers() == 0) return;
  path_.header.stamp = header.stamp;
  path_publisher_.publish(path_);
}

void OdometryPublisher::publishStatus(const ros_io::FrameMessages& frame, const SessionOutput& output,
                                      const FrameCounts& counts) {
  const odometry::FrameResult& result = output.result;
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  auto status = boost::make_shared<VoStatus>();
  status->header.stamp = frame.left_stamp;
  status->header.frame_id = frame.left->header.frame_id;
  status->state = static_cast<std::uint8_t>(result.state);
  status->reason = reasonOf(output);
  status->features_detected = result.features_detected;
  status->features_tracked = result.features_tracked;
  status->features_with_depth = result.features_with_depth;
  status->clique_size = result.clique_size;
  status->inliers = result.inliers;
  status->keyframe = static_cast<std::uint8_t>(result.keyframe);
  status->keyframe_id = result.keyframe_id;
  status->reprojection_error_px = static_cast<float>(result.reprojection_error_px);
  status->skew_s = (frame.right_stamp - frame.left_stamp).toSec();
  status->skew_compensated = static_cast<std::uint8_t>(result.time_offset_compensated);
  status->right_offset_s = static_cast<float>(result.right_stamp_error_s);
  status->right_offset_sigma_s = static_cast<float>(result.right_stamp_sigma_s);
  status->imu_offset_s = nan;
  status->imu_offset_sigma_s = nan;
  status->rotation_disagreement_deg = static_cast<float>(result.rotation_disagreement_rad * kDegPerRad);
  for (const odometry::StageTime& stage : result.stage_times) {
    status->stage_names.emplace_back(stage.stage);
    status->stage_times_ms.push_back(static_cast<float>(stage.milliseconds));
  }
  status->frames = counts.frames;
  status->frames_dropped = counts.dropped;
  status->frames_lost = counts.lost;
  status_publisher_.publish(status);
}

void OdometryPublisher::publishKeyframe(const ros_io::FrameMessages& frame, const SessionOutput& output) {
  if (keyframe_publisher_.getNumSubscribers() == 0) {
    keyframe_maker_.pause();
    return;
  }
  const auto keyframe = keyframe_maker_.add(output.images, output.result);
  if (!keyframe) return;
  auto message = boost::make_shared<Keyframe>(ros_io::toMessage(*keyframe, frame.left->header.frame_id));
  message->header.stamp = frame.left_stamp;
  keyframe_publisher_.publish(message);
}

void OdometryPublisher::publishViews(const ros_io::FrameMessages& frame, const SessionOutput& output) {
  std_msgs::Header header;
  header.stamp = frame.left_stamp;
  header.frame_id = frame.left->header.frame_id;
  if (features_publisher_.getNumSubscribers() > 0) {
    features_publisher_.publish(featureCloud(header, output.result.features));
  }
  if (debug_publisher_.getNumSubscribers() > 0) {
    const cv::Mat view = drawFeatures(output.images.left, output.result);
    debug_publisher_.publish(
        cv_bridge::CvImage(header, sensor_msgs::image_encodings::BGR8, view).toImageMsg());
  }
}

}  // namespace stereo_nav::nodes
