#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "navigation/navigator/grid_route_planner.h"
#include "navigation/navigator/grid_surroundings.h"
#include "nodes/navigator/navigator_messages.h"
#include "nodes/navigator/navigator_node_params.h"
#include "stereo_nav/VoStatus.h"

namespace stereo_nav::nodes {

/// All that the navigator hears: odom, vo/status, obstacles, map, and tf from the map to the odometry's
/// frame. All callbacks run in the thread that asks for the situation.
class NavigatorInputs {
 public:
  NavigatorInputs(ros::NodeHandle& handle, const NavigatorNodeParams& params,
                  navigator::GridRoutePlanner& planner);

  /// What is known now, and tells the planner what is seen. Nothing while no odometry has ever come.
  std::optional<navigator::Situation> situation(double now_s);

  /// Decides anew in which frame goals and ways are until the next call: that of the map where tf has it.
  void choosePlanFrame();
  const std::string& planFrame() const { return plan_frame_; }

  /// A pose of a message in that frame; throws InputError that says why not.
  FloorPose inPlanFrame(const geometry_msgs::PoseStamped& pose) const;

  /// What is wrong with what comes, for diagnostics: one text for each input; empty where all is well.
  const std::map<std::string, std::string>& problems() const { return problems_; }
  std::string odometryTopic() const { return odometry_subscriber_.getTopic(); }

 private:
  void handleOdometry(const nav_msgs::Odometry::ConstPtr& message);
  void handleObstacles(const nav_msgs::OccupancyGrid::ConstPtr& message);
  void handleMap(const nav_msgs::OccupancyGrid::ConstPtr& message);
  /// Whether the pose in the map is unknown; brings T_plan_odom_ up to date.
  bool lost(double now_s);
  void tell(const std::string& input, const std::string& problem);

  const NavigatorNodeParams& params_;
  navigator::GridRoutePlanner& planner_;
  tf2_ros::Buffer tf_buffer_;
  tf2_ros::TransformListener tf_listener_;
  nav_msgs::Odometry::ConstPtr odometry_;
  VoStatus::ConstPtr vo_status_;
  std::optional<navigator::GridSurroundings> surroundings_;
  double surroundings_stamp_s_ = 0.0;
  std::shared_ptr<const grid::OccupancyGrid> map_;
  std::string map_frame_of_message_, plan_frame_;
  Eigen::Isometry2d T_plan_odom_ = Eigen::Isometry2d::Identity();
  double steering_rad_ = 0.0;
  std::map<std::string, std::string> problems_;
  ros::Subscriber odometry_subscriber_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace stereo_nav::nodes
