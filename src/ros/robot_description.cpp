#include "ros/robot_description.h"

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>

#include "core/angles.h"
#include "core/roll_pitch_yaw.h"

namespace stereo_nav::ros_io {
namespace {

using Eigen::Isometry3d;
using kinematics::WheelKind;
using kinematics::WheelParams;

geometry_msgs::TransformStamped toMessage(const std::string& parent, const std::string& child,
                                          const Isometry3d& T) {
  geometry_msgs::TransformStamped message = tf2::eigenToTransform(T);
  message.header.frame_id = parent;
  message.child_frame_id = child;
  return message;
}

std::string linkOf(const BaseJointParams& joint) {
  return joint.name + "_link";
}

/// A joint of URDF with the link that it moves, which is drawn as `visual`.
std::string jointAndLink(const std::string& name, const std::string& type, const std::string& parent,
                         const std::string& child, const Isometry3d& T_parent_child, const std::string& axis,
                         const std::string& limit, const std::string& visual) {
  const Eigen::Vector3d p = T_parent_child.translation();
  const RollPitchYaw angles = RollPitchYaw::of(T_parent_child.linear());
  return fmt::format(
      "  <joint name=\"{}\" type=\"{}\">\n    <parent link=\"{}\"/><child link=\"{}\"/>\n"
      "    <origin xyz=\"{:.6f} {:.6f} {:.6f}\" rpy=\"{:.6f} {:.6f} {:.6f}\"/><axis xyz=\"{}\"/>{}\n  </joint>\n"
      "  <link name=\"{}\">{}</link>\n",
      name, type, parent, child, p.x(), p.y(), p.z(), angles.roll, angles.pitch, angles.yaw, axis, limit,
      child, visual);
}

std::string visual(const std::string& origin, const std::string& geometry, const std::string& colour) {
  return fmt::format("<visual><origin {}/><geometry>{}</geometry><material name=\"{}\"/></visual>", origin,
                     geometry, colour);
}

/// The axis of a wheel points left of the direction in which it rolls.
std::string describeWheel(const WheelParams& wheel, const std::string& base_frame) {
  Isometry3d T_parent_wheel = Isometry3d::Identity();
  T_parent_wheel.translation() << wheel.x_m, wheel.y_m, wheel.radius_m;
  T_parent_wheel.linear() = RollPitchYaw::fromDegrees(0.0, 0.0, wheel.direction_deg).rotation();
  std::string text, parent = base_frame;
  if (wheel.kind == WheelKind::kSteered) {
    text += jointAndLink(wheel.name + "_steering", "continuous", parent, wheel.name + "_steering",
                         T_parent_wheel, "0 0 1", "", "");
    parent = wheel.name + "_steering";
    T_parent_wheel.setIdentity();
  }
  const std::string shape =
      fmt::format("<cylinder radius=\"{:.4f}\" length=\"{:.4f}\"/>", wheel.radius_m, 0.5 * wheel.radius_m);
  return text + jointAndLink(wheel.name + "_wheel", "continuous", parent, wheel.name + "_wheel",
                             T_parent_wheel, "0 1 0", "", visual("rpy=\"1.570796 0 0\"", shape, "dark"));
}

std::string describeJoint(const BaseJointParams& joint, const std::string& base_frame) {
  const char* axis = joint.axis == JointAxis::kRoll    ? "1 0 0"
                     : joint.axis == JointAxis::kPitch ? "0 1 0"
                                                       : "0 0 1";
  const std::string limit =
      fmt::format("<limit lower=\"{:.6f}\" upper=\"{:.6f}\" effort=\"1\" velocity=\"10\"/>",
                  kRadPerDeg * joint.min_deg, kRadPerDeg * joint.max_deg);
  return jointAndLink(joint.name, "revolute", base_frame, linkOf(joint), joint.mounting.T_base_sensor(), axis,
                      limit, visual("rpy=\"0 0 0\"", "<box size=\"0.03 0.03 0.03\"/>", "dark"));
}

/// A box between the wheels.
std::string describeBody(const kinematics::DriveParams& drive) {
  if (drive.wheels.empty()) return {};
  Eigen::AlignedBox2d box;
  double radius_m = 0.0;
  for (const auto& wheel : drive.wheels) {
    box.extend(Eigen::Vector2d(wheel.x_m, wheel.y_m));
    radius_m = std::max(radius_m, wheel.radius_m);
  }
  const Eigen::Vector2d size = box.sizes().cwiseMax(2.0 * radius_m), centre = box.center();
  return visual(fmt::format("xyz=\"{:.4f} {:.4f} {:.4f}\"", centre.x(), centre.y(), 1.5 * radius_m),
                fmt::format("<box size=\"{:.4f} {:.4f} {:.4f}\"/>", size.x(), size.y(), radius_m), "light");
}

}  // namespace

std::vector<geometry_msgs::TransformStamped> fixedTransforms(const RobotGeometry& robot) {
  std::string camera_parent = robot.base_frame;
  Isometry3d T_parent_camera = robot.mounting.camera.T_base_optical();
  for (const auto& joint : robot.joints) {
    if (!joint.carries_camera) continue;
    if (camera_parent != robot.base_frame)
      throw ParameterError("base: two joints have carries_camera, but the cameras turn with one only");
    camera_parent = linkOf(joint);
    T_parent_camera = joint.mounting.T_base_sensor().inverse() * T_parent_camera;
  }
  std::vector<geometry_msgs::TransformStamped> transforms = {
      toMessage(camera_parent, robot.camera_frame, T_parent_camera),
      toMessage(robot.base_frame, robot.imu_frame, robot.mounting.imu.T_base_sensor())};
  if (!robot.laser_frame.empty())
    transforms.push_back(
        toMessage(robot.base_frame, robot.laser_frame, robot.mounting.laser.T_base_sensor()));
  for (const auto& range : robot.ranges)
    transforms.push_back(toMessage(robot.base_frame, range.frame(), range.mounting.T_base_sensor()));
  return transforms;
}

std::string robotDescription(const RobotGeometry& robot) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<robot name=\"stereo_nav\">\n"
      "  <material name=\"light\"><color rgba=\"0.7 0.7 0.75 0.8\"/></material>\n"
      "  <material name=\"dark\"><color rgba=\"0.2 0.2 0.2 1\"/></material>\n";
  text += fmt::format("  <link name=\"{}\">{}</link>\n", robot.base_frame, describeBody(robot.drive));
  for (const auto& wheel : robot.drive.wheels) text += describeWheel(wheel, robot.base_frame);
  for (const auto& joint : robot.joints) text += describeJoint(joint, robot.base_frame);
  return text + "</robot>\n";
}

}  // namespace stereo_nav::ros_io
