#include "support/wiggle_bag.h"

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>

#include <algorithm>

#include "core/optical_axes.h"
#include "ros/bag_file.h"
#include "sim/image_sensor.h"
#include "sim/random.h"
#include "sim/renderer.h"
#include "sim/scenario.h"
#include "stereo_nav/core/lie.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::test {
namespace {

constexpr double kDegree = M_PI / 180.0;
const ros::Time kStart(1000.0);

/// Rectified left optical frame in the world at a time: half a metre above the floor, looking along x.
Eigen::Isometry3d poseAt(const Wiggle& wiggle, double time_s) {
  Eigen::Matrix3d R_world_camera;
  R_world_camera = opticalToBody();
  const Eigen::Vector3d angle =
      kDegree *
      wiggle.amplitude_deg.cwiseProduct((2.0 * M_PI * time_s * wiggle.frequency_hz).array().sin().matrix());
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = R_world_camera * expRotation({0, angle.y(), 0}) * expRotation({angle.x(), 0, 0}) *
                  expRotation({0, 0, angle.z()});
  // Hands do not turn about the lens.
  pose.translation() = Eigen::Vector3d(0.0, 0.0, 0.5) + pose.linear() * Eigen::Vector3d(0.03, 0.02, 0.15);
  return pose;
}

sensor_msgs::CameraInfo infoOf(const sim::CameraCalibration& camera, const std_msgs::Header& header) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(camera.D.begin(), camera.D.end());
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(info.K.data()) = camera.K;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(info.R.data()) = camera.R;
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(info.P.data()) = camera.P;
  return info;
}

sensor_msgs::Image messageOf(const cv::Mat& image, const std_msgs::Header& header) {
  sensor_msgs::Image message;
  message.header = header;
  message.width = static_cast<std::uint32_t>(image.cols);
  message.height = static_cast<std::uint32_t>(image.rows);
  message.step = message.width;
  message.encoding = "mono8";
  message.data.assign(image.data, image.data + image.total());
  return message;
}

void writeImages(ros_io::BagFile& bag, const Wiggle& wiggle) {
  const std::string source = STEREO_NAV_SOURCE_DIR;
  const sim::Scene scene(sim::loadScenario(source + "/config/scenarios/arena.yaml").scene);
  for (const bool right : {false, true}) {
    const auto camera =
        sim::loadCameraCalibration(source + "/config/thesis/" + (right ? "right" : "left") + ".yaml");
    const sim::Renderer renderer(camera, 4);
    const sim::ImageSensor sensor(camera.width, camera.height, sim::SensorParams(), sim::CameraResponse());
    Eigen::Isometry3d T_left_raw = Eigen::Isometry3d::Identity();
    T_left_raw.translation().x() = camera.offsetX_m();
    T_left_raw.linear() = camera.R;
    const auto path = [&](double time_s) -> Eigen::Isometry3d { return poseAt(wiggle, time_s) * T_left_raw; };
    const int frames = static_cast<int>(wiggle.duration_s * wiggle.rate_hz);
    for (int frame = 0; frame < frames; ++frame) {
      sim::Shutter shutter;
      shutter.middle_s = frame / wiggle.rate_hz;
      shutter.exposure_s = 0.004;
      std_msgs::Header header;
      header.stamp = kStart + ros::Duration(shutter.middle_s);
      header.frame_id = ros_io::frames::kLeftOptical;
      const std::uint64_t key = sim::streamKey(1, sim::Stream::kPixelNoise, right ? 1 : 0, frame);
      const cv::Mat image = sensor.expose(renderer.render(scene, path, shutter), key);
      namespace topics = ros_io::topics;
      bag.write(right ? topics::kRightImage : topics::kLeftImage, header.stamp, messageOf(image, header));
      bag.write(right ? topics::kRightInfo : topics::kLeftInfo, header.stamp, infoOf(camera, header));
    }
  }
}

void writeImu(ros_io::BagFile& bag, const Wiggle& wiggle) {
  const Eigen::Vector3d bias_rad_s(0.01, -0.02, 0.03);
  constexpr double kNoise_rad_s = 0.005, kPeriod_s = 0.01, kStep_s = 1e-4;
  sim::RandomStream random(sim::streamKey(1, sim::Stream::kImu));
  for (double time_s = 0.0; time_s < wiggle.duration_s; time_s += kPeriod_s) {
    sensor_msgs::Imu imu;
    imu.header.stamp = kStart + ros::Duration(time_s + wiggle.imu_offset_s);
    imu.header.frame_id = ros_io::frames::kImu;
    imu.linear_acceleration_covariance[0] = -1.0;
    if (wiggle.attitudes) {
      const Eigen::Quaterniond q(poseAt(wiggle, time_s).linear() * wiggle.R_camera_imu);
      imu.orientation.w = q.w();
      imu.orientation.x = q.x();
      imu.orientation.y = q.y();
      imu.orientation.z = q.z();
      imu.angular_velocity_covariance[0] = -1.0;
    } else {
      const Eigen::Matrix3d before = poseAt(wiggle, time_s - kStep_s).linear(),
                            after = poseAt(wiggle, time_s + kStep_s).linear();
      const Eigen::Vector3d camera_rate = logRotation(before.transpose() * after) / (2.0 * kStep_s);
      Eigen::Vector3d rate = wiggle.R_camera_imu.transpose() * camera_rate + bias_rad_s;
      for (int axis = 0; axis < 3; ++axis) rate(axis) += kNoise_rad_s * random.normal();
      imu.angular_velocity.x = rate.x();
      imu.angular_velocity.y = rate.y();
      imu.angular_velocity.z = rate.z();
      imu.orientation_covariance[0] = -1.0;
    }
    bag.write(ros_io::topics::kImu, imu.header.stamp, imu);
  }
}

}  // namespace

void writeWiggleBag(const std::string& path, const Wiggle& wiggle) {
  ros_io::BagFile bag(path);
  writeImages(bag, wiggle);
  writeImu(bag, wiggle);
  bag.commit();
}

}  // namespace stereo_nav::test
