#include "support/fixture_bag.h"

#include <cv_bridge/cv_bridge.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Imu.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <opencv2/imgcodecs.hpp>

#include "core/base_pose.h"
#include "core/optical_axes.h"
#include "stereo_nav/StereoSync.h"
#include "stereo_nav/ros/topics.h"
#include "support/textured_room.h"

namespace stereo_nav::test {
namespace {

namespace topics = ros_io::topics;
namespace frames = ros_io::frames;

constexpr double kStart_s = 1000.0;

ros::Time stampOf(double time_s) {
  return ros::Time(kStart_s + time_s);
}

/// Camera of the thesis' mounting, 0.283 m above the ground; x right, y down, z forward.
Eigen::Isometry3d baseToCamera() {
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.linear() = opticalToBody();
  T_base_camera.translation() << 0.10, 0.06, 0.283;
  return T_base_camera;
}

Eigen::Isometry3d basePoseAt(double time_s) {
  return basePose(baseToCamera(), roomDrive(time_s));
}

std::string inRig(const FixtureBag& fixture, const char* topic) {
  return fixture.rig.empty() ? topic : fixture.rig + "/" + topic;
}

sensor_msgs::Image imageOf(const cv::Mat& grey, const ros::Time& stamp) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frames::kLeftOptical;
  return *cv_bridge::CvImage(header, "mono8", grey).toImageMsg();
}

void writeImage(rosbag::Bag& bag, const FixtureBag& fixture, const std::string& topic, const cv::Mat& grey,
                const ros::Time& stamp) {
  const sensor_msgs::Image image = imageOf(grey, stamp);
  if (!fixture.compressed_bayer) return bag.write(topic, stamp, image);
  sensor_msgs::CompressedImage compressed;
  compressed.header = image.header;
  compressed.format = "bayer_rggb8; png compressed ";  // a grey scene looks the same to all colours
  cv::imencode(".png", grey, compressed.data);
  bag.write(topic + topics::kCompressed, stamp, compressed);
}

void writeTransforms(rosbag::Bag& bag) {
  tf2_msgs::TFMessage message;
  geometry_msgs::TransformStamped camera = tf2::eigenToTransform(baseToCamera());
  camera.header.stamp = stampOf(0.0);
  camera.header.frame_id = frames::kBase;
  camera.child_frame_id = frames::kLeftOptical;
  geometry_msgs::TransformStamped imu = tf2::eigenToTransform(Eigen::Isometry3d::Identity());
  imu.header = camera.header;
  imu.child_frame_id = frames::kImu;
  message.transforms = {camera, imu};
  bag.write(std::string("/") + topics::kTfStatic, stampOf(0.0), message);
}

void writeFrame(rosbag::Bag& bag, const FixtureBag& fixture, int index) {
  const vision::StereoCalibration c = roomCalibration();
  const double left_s = fixture.period_s * index;
  const double right_s = left_s + fixture.right_lag_s;
  auto images = TexturedRoom().renderPair(roomDrive(left_s), roomDrive(right_s), c);
  sensor_msgs::CameraInfo left_info = cameraInfo(c, false);
  sensor_msgs::CameraInfo right_info = cameraInfo(c, true);
  left_info.header.stamp = stampOf(left_s);
  right_info.header.stamp = stampOf(right_s);
  if (fixture.toe_in_rad != 0.0) {
    const Eigen::Matrix3d R = rectifiedFromRaw(fixture.toe_in_rad);
    const Eigen::Isometry3d T_room_right =
        roomDrive(right_s) * Eigen::Translation3d(c.baseline_m, 0.0, 0.0) * Eigen::Isometry3d(R);
    images.right = TexturedRoom().render(T_room_right, c.fx, c.fy, c.right_cx, c.cy, {c.width, c.height});
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(right_info.R.data()) = R;
  }
  writeImage(bag, fixture, inRig(fixture, topics::kLeftImage), images.left, stampOf(left_s));
  const bool with_infos = index % fixture.info_every == 0;
  if (with_infos) bag.write(inRig(fixture, topics::kLeftInfo), stampOf(left_s), left_info);
  writeImage(bag, fixture, inRig(fixture, topics::kRightImage), images.right, stampOf(right_s));
  if (with_infos) bag.write(inRig(fixture, topics::kRightInfo), stampOf(right_s), right_info);
  if (!fixture.rig.empty()) {
    const std::string other = std::string("/a/") + topics::kLeftImage;
    bag.write(other, stampOf(left_s), imageOf(images.right, stampOf(left_s)));
  }
  StereoSync sync;
  sync.header = left_info.header;
  sync.left_stamp = stampOf(left_s);
  sync.right_stamp = stampOf(right_s);
  sync.skew_s = fixture.right_lag_s;
  sync.left_sequence = sync.right_sequence = static_cast<unsigned>(index);
  bag.write(inRig(fixture, topics::kSync), stampOf(right_s), sync);
}

void writeGroundTruth(rosbag::Bag& bag, const FixtureBag& fixture, double time_s) {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = stampOf(time_s);
  odometry.header.frame_id = frames::kOdom;
  odometry.child_frame_id = frames::kBase;
  odometry.pose.pose = tf2::toMsg(basePoseAt(time_s));
  bag.write(inRig(fixture, topics::kGroundTruth), stampOf(time_s), odometry);
}

void writeImu(rosbag::Bag& bag, const FixtureBag& fixture, double time_s) {
  constexpr double kStep_s = 1e-4;
  sensor_msgs::Imu imu;
  imu.header.stamp = stampOf(time_s);
  imu.header.frame_id = frames::kImu;
  const Eigen::Isometry3d T_odom_base = basePoseAt(time_s);
  imu.orientation = tf2::toMsg(Eigen::Quaterniond(T_odom_base.linear()));
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(T_odom_base.linear().transpose() * basePoseAt(time_s + kStep_s).linear()));
  const Eigen::Vector3d rate = turn.axis() * turn.angle() / kStep_s;
  tf2::toMsg(rate, imu.angular_velocity);
  imu.linear_acceleration_covariance[0] = -1.0;
  bag.write(inRig(fixture, topics::kImu), stampOf(time_s), imu);
}

}  // namespace

Eigen::Matrix3d rectifiedFromRaw(double toe_in_rad) {
  return Eigen::AngleAxisd(-toe_in_rad, Eigen::Vector3d::UnitY()).toRotationMatrix();
}

sensor_msgs::CameraInfo cameraInfo(const vision::StereoCalibration& c, bool right) {
  sensor_msgs::CameraInfo info;
  info.header.frame_id = frames::kLeftOptical;
  info.width = static_cast<unsigned>(c.width);
  info.height = static_cast<unsigned>(c.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  const double cx = right ? c.right_cx : c.cx;
  info.K = {c.fx, 0, cx, 0, c.fy, c.cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {c.fx, 0, cx, right ? -c.fx * c.baseline_m : 0, 0, c.fy, c.cy, 0, 0, 0, 1, 0};
  return info;
}

void writeFixtureBag(const std::string& path, const FixtureBag& fixture) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  if (fixture.with_transforms) writeTransforms(bag);
  for (int i = 0; i < fixture.frames; ++i) writeFrame(bag, fixture, i);
  const double end_s = fixture.period_s * fixture.frames + fixture.right_lag_s;
  constexpr double kImuPeriod_s = 0.01;
  for (double time_s = 0.0; time_s <= end_s + kImuPeriod_s; time_s += kImuPeriod_s) {
    if (fixture.with_imu) writeImu(bag, fixture, time_s);
    if (fixture.with_ground_truth) writeGroundTruth(bag, fixture, time_s);
  }
  bag.close();
}

}  // namespace stereo_nav::test
