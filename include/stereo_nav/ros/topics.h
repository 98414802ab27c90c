#pragma once

/// Names that the nodes, the tools and the recordings share. All are relative, so that a namespace can hold a
/// whole rig.
namespace stereo_nav::ros_io::topics {

constexpr const char* kLeftImage = "camera/left/image_raw";    ///< sensor_msgs/Image
constexpr const char* kRightImage = "camera/right/image_raw";  ///< sensor_msgs/Image
/// Ending of the topics of compressed images: sensor_msgs/CompressedImage.
constexpr const char* kCompressed = "/compressed";
constexpr const char* kLeftInfo = "camera/left/camera_info";    ///< sensor_msgs/CameraInfo
constexpr const char* kRightInfo = "camera/right/camera_info";  ///< sensor_msgs/CameraInfo
/// sensor_msgs/CameraInfo for the image nodelets: checked, of the images as they are delivered.
constexpr const char* kLeftCheckedInfo = "camera/left/checked_info";
constexpr const char* kRightCheckedInfo = "camera/right/checked_info";  ///< the same of the right camera
constexpr const char* kSync = "camera/sync";                            ///< stereo_nav/StereoSync
constexpr const char* kImu = "imu/data";                                ///< sensor_msgs/Imu
/// The thesis' topic: orientation without a header.
constexpr const char* kImuQuaternion = "imu_quat";
constexpr const char* kWheelTicks = "wheel_ticks";    ///< stereo_nav/WheelTicks
constexpr const char* kScan = "scan";                 ///< sensor_msgs/LaserScan
constexpr const char* kJointStates = "joint_states";  ///< sensor_msgs/JointState of wheels and servos
constexpr const char* kBattery = "battery";           ///< sensor_msgs/BatteryState
constexpr const char* kRange = "range/";              ///< sensor_msgs/Range, followed by a name
constexpr const char* kSwitch = "switch/";            ///< std_msgs/Bool, followed by a name
constexpr const char* kJoint = "joints/";             ///< std_msgs/Float64, rad, followed by a name: wanted
constexpr const char* kActuator = "actuators/";   ///< std_msgs/Float64, -1 to 1, followed by a name: wanted
constexpr const char* kActuatorState = "/state";  ///< ending of kActuator's topic with the level now
constexpr const char* kCmdVel = "cmd_vel";        ///< geometry_msgs/Twist that the base follows
/// Senders of velocities, by rank: cmd_vel_mux lets the first that is heard pass to cmd_vel.
constexpr const char* kCmdVelStop = "cmd_vel_stop";
constexpr const char* kCmdVelManual = "cmd_vel_manual";    ///< teleop, operator page
constexpr const char* kCmdVelAuto = "cmd_vel_auto";        ///< the navigator
constexpr const char* kWheelOdometry = "wheel/odom";       ///< nav_msgs/Odometry by the wheels
constexpr const char* kLaserOdometry = "laser/odom";       ///< nav_msgs/Odometry by the laser
constexpr const char* kLaserStatus = "laser/status";       ///< stereo_nav/LaserStatus
constexpr const char* kGroundTruth = "ground_truth/odom";  ///< nav_msgs/Odometry
/// In simulated recordings: the moments at which the robot passes the way-points of its path.
constexpr const char* kWaypoint = "ground_truth/waypoint";
constexpr const char* kTf = "tf";               ///< tf2_msgs/TFMessage
constexpr const char* kTfStatic = "tf_static";  ///< tf2_msgs/TFMessage

}  // namespace stereo_nav::ros_io::topics

namespace stereo_nav::ros_io::frames {

constexpr const char* kOdom = "odom";       ///< where the odometry begins
constexpr const char* kBase = "base_link";  ///< the robot: x forward, y left, z up
/// The base on the floor, with its axes (REP-120).
constexpr const char* kFootprint = "base_footprint";
/// Frame of both cameras' images and infos: image_geometry::StereoCameraModel asserts that the two are equal.
constexpr const char* kLeftOptical = "camera_left_optical";
constexpr const char* kLaser = "laser";           ///< the laser of an imported log, in its own axes
constexpr const char* kLaserLink = "laser_link";  ///< the laser of a robot: x along its own zero, z upwards
/// World of ground truth that a SLAM system made from the recording itself: right over metres, but each pose
/// jitters by a centimetre or two, so that the poses add up to a longer way than was driven.
constexpr const char* kCorrectedMap = "corrected_map";
constexpr const char* kImu = "imu_link";  ///< the IMU, in its own axes

}  // namespace stereo_nav::ros_io::frames
