// Checks the whole rig file, publishes the mounting of its sensors as static transforms, and sets
// robot_description, from which robot_state_publisher knows wheels and servos.
#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "core/rig_file.h"
#include "kinematics/drive_file.h"
#include "nodes/rig_transforms/rig_transforms_params.h"
#include "odometry/wheel/wheel_odometry_params.h"
#include "ros/capture_setup.h"
#include "ros/imu_bridge_params.h"
#include "ros/node_program.h"
#include "ros/parameter_server.h"
#include "ros/robot_description.h"
#include "ros/stereo_processing.h"

namespace stereo_nav::nodes {
namespace {

using ros_io::BaseBridgeParams;
using ros_io::RobotGeometry;

/// Sections that other nodes read are checked here, too, so that this node reports every mistake in the file.
void checkSections(const ros::NodeHandle& private_handle) {
  ros_io::CaptureSetup cameras;
  cameras.read({ros_io::rigSource(private_handle, rig_sections::kCameras)});
  ros_io::ImuBridgeParams imu;
  ros_io::readParameters({ros_io::rigSource(private_handle, rig_sections::kImu)}, imu);
  ros_io::DisparityParams disparity;
  ros_io::readParameters({ros_io::rigSource(private_handle, rig_sections::kDisparity)}, disparity);
  const RigFile rig = RigFile::load(private_handle.param<std::string>("rig", ""));
  if (!rig.section(rig_sections::kDrive).IsNull()) odometry::loadWheelOdometry("", rig);
}

RobotGeometry readGeometry(const RigTransformsParams& params, const RigFile& rig) {
  RobotGeometry robot;
  robot.mounting = rig.mounting();
  robot.base_frame = params.base_frame;
  robot.camera_frame = params.camera_frame;
  robot.imu_frame = params.imu_frame;
  if (!rig.section(rig_sections::kLaser).IsNull()) robot.laser_frame = params.laser_frame;
  BaseBridgeParams base;
  stereo_nav::readParameters(rig.section(rig_sections::kBase), rig.sectionName(rig_sections::kBase), base);
  base.checkNames();
  robot.joints = base.joints;
  robot.ranges = base.ranges;
  if (!rig.section(rig_sections::kDrive).IsNull()) robot.drive = kinematics::readDrive(rig);
  return robot;
}

void addPose(diagnostic_updater::DiagnosticStatusWrapper& status, const std::string& name,
             const SensorMounting& pose) {
  status.addf(name + " x, y, z [m]", "%.3f, %.3f, %.3f", pose.x_m, pose.y_m, pose.z_m);
  status.addf(name + " roll, pitch, yaw [deg]", "%.2f, %.2f, %.2f", pose.roll_deg, pose.pitch_deg,
              pose.yaw_deg);
}

int run() {
  ros::NodeHandle handle, private_handle("~");
  RigTransformsParams params;
  ros_io::readParameters({ros_io::serverSource(private_handle, {"diagnostic_period"})}, params);
  const auto rig = private_handle.param<std::string>("rig", "");
  if (rig.empty()) throw ParameterError("~rig is not set; it is the path of the rig file");
  const RobotGeometry robot = readGeometry(params, RigFile::load(rig));
  const Mounting& mounting = robot.mounting;
  checkSections(private_handle);

  handle.setParam("robot_description", ros_io::robotDescription(robot));
  tf2_ros::StaticTransformBroadcaster broadcaster;
  auto transforms = ros_io::fixedTransforms(robot);
  for (auto& transform : transforms) transform.header.stamp = ros::Time::now();
  broadcaster.sendTransform(transforms);

  diagnostic_updater::Updater updater(handle, private_handle);
  updater.setHardwareID("none");
  updater.add("mounting", [&](diagnostic_updater::DiagnosticStatusWrapper& status) {
    status.summary(diagnostic_msgs::DiagnosticStatus::OK, "from " + rig);
    addPose(status, "camera", mounting.camera);
    addPose(status, "IMU", mounting.imu);
    if (!robot.laser_frame.empty()) addPose(status, "laser", mounting.laser);
  });
  const ros::WallTimer timer =
      handle.createWallTimer(ros::WallDuration(1.0), [&](const ros::WallTimerEvent&) { updater.update(); });
  ros::spin();
  return 0;
}

}  // namespace
}  // namespace stereo_nav::nodes

int main(int argc, char** argv) {
  return stereo_nav::ros_io::runNode(argc, argv, "rig_transforms", stereo_nav::nodes::run);
}
