#pragma once

#include <actionlib/server/simple_action_server.h>
#include <diagnostic_updater/diagnostic_updater.h>
#include <move_base_msgs/MoveBaseAction.h>
#include <nav_msgs/GetPlan.h>
#include <ros/ros.h>
#include <std_srvs/Empty.h>

#include <optional>
#include <string>
#include <vector>

#include "nodes/navigator/navigator_inputs.h"
#include "stereo_nav/NavigatorStatus.h"

namespace stereo_nav::nodes {

/// Goals from the action move_base, from move_base_simple/goal, and paths from navigator/path, of which the
/// newest counts; publishes cmd_vel_auto while it has one, plan, navigator/status and diagnostics; serves
/// make_plan and clear_costmaps. Names and types are those of move_base. All callbacks run in one thread.
class NavigatorNode {
 public:
  /// Throws ParameterError, and InputError for a footprint that cannot be used.
  NavigatorNode(ros::NodeHandle handle, ros::NodeHandle private_handle, const std::string& name);

 private:
  using Server = actionlib::SimpleActionServer<move_base_msgs::MoveBaseAction>;

  void handleGoal();
  void handlePreemption();
  void handleSimpleGoal(const geometry_msgs::PoseStamped::ConstPtr& message);
  void handlePath(const nav_msgs::Path::ConstPtr& message);
  bool handleMakePlan(nav_msgs::GetPlan::Request& request, nav_msgs::GetPlan::Response& response);
  bool handleClear(std_srvs::Empty::Request& request, std_srvs::Empty::Response& response);

  /// One period of control.
  void handleTimer(const ros::TimerEvent& event);
  bool hasGoal() const;
  void start(const FloorPose& goal, const std::vector<Eigen::Vector2d>& path);
  /// Gives the goal up and stops.
  void stop();
  /// Tells the action's client, and counts, when a goal has just ended.
  void reportEnd();
  void refuse(const std::string& why);
  void publish(const navigator::Twist& twist);
  void publishPlan();
  void publishFeedback(const navigator::Situation& situation);
  void publishStatus(double now_s);
  void fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status);

  std::string name_;
  NavigatorNodeParams params_;
  navigator::GridRoutePlanner planner_;
  navigator::Navigator navigator_;
  NavigatorInputs inputs_;
  Server server_;
  bool with_action_ = false;  ///< the goal is that of the action
  bool was_active_ = false;   ///< in the last period
  std::string words_;         ///< why the node itself, not the navigator, does what it does; often empty
  int plans_ = 0;
  std::uint32_t reached_ = 0, failed_ = 0;
  NavigatorStatus status_;
  double status_s_ = 0.0;
  diagnostic_updater::Updater updater_;
  ros::Publisher velocity_, plan_, status_publisher_, action_goal_;
  // Last, so that no callback runs any more when the others are destroyed.
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::Timer timer_;
};

}  // namespace stereo_nav::nodes
