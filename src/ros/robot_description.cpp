#include "ros/robot_description.h"

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <set>

#include "core/angles.h"
#include "core/roll_pitch_yaw.h"

namespace stereo_nav::ros_io {
namespace {

using Eigen::Isometry3d;
using kinematics::WheelKind;
using kinematics::WheelParams;

constexpr const char* kWheelSuffix = "_wheel";
constexpr const char* kSteeringSuffix = "_steering";

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

std::string origin(const Isometry3d& T) {
  const Eigen::Vector3d p = T.translation();
  const RollPitchYaw angles = RollPitchYaw::of(T.linear());
  return fmt::format("<origin xyz=\"{:.6f} {:.6f} {:.6f}\" rpy=\"{:.6f} {:.6f} {:.6f}\"/>", p.x(), p.y(),
                     p.z(), angles.roll, angles.pitch, angles.yaw);
}

/// A joint of URDF with the link that it moves, which is drawn as `visual`.
std::string jointAndLink(const std::string& name, const std::string& type, const std::string& parent,
                         const std::string& child, const Isometry3d& T_parent_child, const std::string& axis,
                         const std::string& limit, const std::string& visual) {
  return fmt::format(
      "  <joint name=\"{}\" type=\"{}\">\n    <parent link=\"{}\"/><child link=\"{}\"/>\n"
      "    {}<axis xyz=\"{}\"/>{}\n  </joint>\n  <link name=\"{}\">{}</link>\n",
      name, type, parent, child, origin(T_parent_child), axis, limit, child, visual);
}

std::string visual(const Isometry3d& T_link_shape, const std::string& geometry, const std::string& colour) {
  return fmt::format("<visual>{}<geometry>{}</geometry><material name=\"{}\"/></visual>",
                     origin(T_link_shape), geometry, colour);
}

std::string box(double x_m, double y_m, double z_m) {
  return fmt::format("<box size=\"{:.4f} {:.4f} {:.4f}\"/>", x_m, y_m, z_m);
}

std::string cylinder(double radius_m, double length_m) {
  return fmt::format("<cylinder radius=\"{:.4f}\" length=\"{:.4f}\"/>", radius_m, length_m);
}

/// The axis of a wheel points left of the direction in which it rolls.
std::string describeWheel(const WheelParams& wheel, const std::string& base_frame) {
  Isometry3d T_parent_wheel = Isometry3d::Identity();
  T_parent_wheel.translation() << wheel.x_m, wheel.y_m, wheel.radius_m;
  T_parent_wheel.linear() = RollPitchYaw::fromDegrees(0.0, 0.0, wheel.direction_deg).rotation();
  std::string text, parent = base_frame;
  if (wheel.kind == WheelKind::kSteered) {
    text += jointAndLink(wheel.name + kSteeringSuffix, "continuous", parent, wheel.name + kSteeringSuffix,
                         T_parent_wheel, "0 0 1", "", "");
    parent = wheel.name + kSteeringSuffix;
    T_parent_wheel.setIdentity();
  }
  Isometry3d T_wheel_shape = Isometry3d::Identity();
  T_wheel_shape.linear() = RollPitchYaw::fromDegrees(90.0, 0.0, 0.0).rotation();
  const std::string tyre = visual(T_wheel_shape, cylinder(wheel.radius_m, 0.5 * wheel.radius_m), "dark");
  return text + jointAndLink(wheel.name + kWheelSuffix, "continuous", parent, wheel.name + kWheelSuffix,
                             T_parent_wheel, "0 1 0", "", tyre);
}

/// `carried`: what is drawn on it besides itself.
std::string describeJoint(const BaseJointParams& joint, const std::string& base_frame,
                          const std::string& carried) {
  const char* axis = joint.axis == JointAxis::kRoll    ? "1 0 0"
                     : joint.axis == JointAxis::kPitch ? "0 1 0"
                                                       : "0 0 1";
  const std::string limit =
      fmt::format("<limit lower=\"{:.6f}\" upper=\"{:.6f}\" effort=\"1\" velocity=\"10\"/>",
                  kRadPerDeg * joint.min_deg, kRadPerDeg * joint.max_deg);
  const std::string servo = visual(Isometry3d::Identity(), box(0.03, 0.03, 0.03), "dark");
  return jointAndLink(joint.name, "revolute", base_frame, linkOf(joint), joint.mounting.T_base_sensor(), axis,
                      limit, servo + carried);
}

/// A box between the wheels.
std::string describeBody(const kinematics::DriveParams& drive) {
  if (drive.wheels.empty()) return {};
  Eigen::AlignedBox2d contacts;
  double radius_m = 0.0;
  for (const auto& wheel : drive.wheels) {
    contacts.extend(Eigen::Vector2d(wheel.x_m, wheel.y_m));
    radius_m = std::max(radius_m, wheel.radius_m);
  }
  const Eigen::Vector2d size = contacts.sizes().cwiseMax(2.0 * radius_m), centre = contacts.center();
  Isometry3d T_base_body = Isometry3d::Identity();
  T_base_body.translation() << centre.x(), centre.y(), 1.5 * radius_m;
  return visual(T_base_body, box(size.x(), size.y(), radius_m), "light");
}

/// The servo that carries the cameras; null: none.
const BaseJointParams* cameraJoint(const RobotGeometry& robot) {
  const BaseJointParams* found = nullptr;
  for (const auto& joint : robot.joints) {
    if (!joint.carries_camera) continue;
    if (found != nullptr)
      throw ParameterError("base: two joints have carries_camera, but the cameras turn with one only");
    found = &joint;
  }
  return found;
}

/// Takes coordinates of base_link into the link that carries the cameras, at an angle of zero.
Isometry3d fromBaseToCarrier(const BaseJointParams* joint) {
  return joint != nullptr ? joint->mounting.T_base_sensor().inverse() : Isometry3d::Identity();
}

/// Sensors that are fixed to the base.
std::string describeSensors(const RobotGeometry& robot) {
  std::string text = visual(robot.mounting.imu.T_base_sensor(), box(0.02, 0.016, 0.004), "sensor");
  if (!robot.laser_frame.empty())
    text += visual(robot.mounting.laser.T_base_sensor(), cylinder(0.035, 0.04), "sensor");
  for (const auto& range : robot.ranges)
    text += visual(range.mounting.T_base_sensor(), box(0.02, 0.04, 0.02), "sensor");
  for (const auto& finder : robot.range_finders)
    text += visual(finder.mounting.T_base_sensor(), box(0.02, 0.04, 0.02), "sensor");
  return text;
}

/// `transforms`: of the sensors. Wheels and servos have frames, too, which robot_state_publisher publishes.
void refuseSharedFrames(const RobotGeometry& robot,
                        const std::vector<geometry_msgs::TransformStamped>& transforms) {
  std::vector<std::string> frames = {robot.base_frame};
  for (const auto& wheel : robot.drive.wheels) frames.push_back(wheel.name + kWheelSuffix);
  for (const auto& wheel : robot.drive.wheels) {
    if (wheel.kind == WheelKind::kSteered) frames.push_back(wheel.name + kSteeringSuffix);
  }
  for (const auto& joint : robot.joints) frames.push_back(linkOf(joint));
  for (const auto& transform : transforms) frames.push_back(transform.child_frame_id);
  std::set<std::string> seen;
  for (const std::string& frame : frames) {
    if (!seen.insert(frame).second)
      throw ParameterError("two parts have the frame '" + frame +
                           "', so that nobody could tell where it is; give each its own name or frame_id: "
                           "sections drive, base, laser and range_finders");
  }
}

}  // namespace

std::vector<geometry_msgs::TransformStamped> fixedTransforms(const RobotGeometry& robot) {
  const BaseJointParams* const joint = cameraJoint(robot);
  std::vector<geometry_msgs::TransformStamped> transforms = {
      toMessage(joint != nullptr ? linkOf(*joint) : robot.base_frame, robot.camera_frame,
                fromBaseToCarrier(joint) * robot.mounting.camera.T_base_optical())};
  const auto fixToBase = [&](const std::string& frame, const SensorMounting& mounting) {
    transforms.push_back(toMessage(robot.base_frame, frame, mounting.T_base_sensor()));
  };
  fixToBase(robot.imu_frame, robot.mounting.imu);
  if (!robot.laser_frame.empty()) fixToBase(robot.laser_frame, robot.mounting.laser);
  for (const auto& range : robot.ranges) fixToBase(range.frame(), range.mounting);
  for (const auto& finder : robot.range_finders) fixToBase(finder.frame(), finder.mounting);
  refuseSharedFrames(robot, transforms);
  return transforms;
}

std::string robotDescription(const RobotGeometry& robot) {
  const BaseJointParams* const camera_joint = cameraJoint(robot);
  const std::string camera = visual(fromBaseToCarrier(camera_joint) * robot.mounting.camera.T_base_sensor(),
                                    box(0.02, 0.03, 0.03), "sensor");
  std::string text =
      "<?xml version=\"1.0\"?>\n<robot name=\"stereo_nav\">\n"
      "  <material name=\"light\"><color rgba=\"0.7 0.7 0.75 0.8\"/></material>\n"
      "  <material name=\"dark\"><color rgba=\"0.2 0.2 0.2 1\"/></material>\n"
      "  <material name=\"sensor\"><color rgba=\"0.2 0.5 0.9 1\"/></material>\n";
  text += fmt::format(
      "  <link name=\"{}\">{}</link>\n", robot.base_frame,
      describeBody(robot.drive) + describeSensors(robot) + (camera_joint != nullptr ? "" : camera));
  for (const auto& wheel : robot.drive.wheels) text += describeWheel(wheel, robot.base_frame);
  for (const auto& joint : robot.joints)
    text += describeJoint(joint, robot.base_frame, &joint == camera_joint ? camera : "");
  return text + "</robot>\n";
}

}  // namespace stereo_nav::ros_io
