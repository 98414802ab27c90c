#pragma once

#include <ros/ros.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "nodes/visual_odometry/disparity_view.h"
#include "nodes/visual_odometry/health.h"
#include "nodes/visual_odometry/odometry_inputs.h"
#include "nodes/visual_odometry/odometry_publisher.h"
#include "nodes/visual_odometry/odometry_session.h"
#include "ros/inbox.h"
#include "ros/live_parameters.h"
#include "stereo_nav/SetPose.h"

namespace stereo_nav::nodes {

/// The visual_odometry node; the nodelet uses the same class with its own handles. Callbacks only queue; one
/// thread runs the odometry and publishes. The handles' callbacks must come from one thread.
class VisualOdometryNode {
 public:
  /// Throws ParameterError.
  VisualOdometryNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                     const std::string& name);
  ~VisualOdometryNode();

 private:
  void applyLive(const VisualOdometryParams& params);
  bool handleReset(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);
  bool handleSetPose(SetPose::Request& request, SetPose::Response& response);
  void handleTimer(const ros::WallTimerEvent& event);

  void work();
  void processFrame(const ros_io::Inbox::Work& work);

  ros::NodeHandle handle_;
  ros::NodeHandle private_handle_;
  std::string name_;
  VisualOdometryParams params_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  Health health_;

  unsigned int ticks_ = 0;
  ros_io::Inbox inbox_;
  std::mutex session_mutex_;
  OdometrySession session_;

  OdometryInputs inputs_;
  /// Begun after the inputs: who sees `vo/status` advertised knows that the node listens to everything.
  OdometryPublisher publisher_;  ///< guarded by session_mutex_
  DisparityView disparity_view_;
  ros::ServiceServer reset_service_, set_pose_service_;
  std::unique_ptr<ros_io::LiveParameters<VisualOdometryParams>> live_parameters_;
  ros::WallTimer timer_;
  std::thread worker_;
};

}  // namespace stereo_nav::nodes
