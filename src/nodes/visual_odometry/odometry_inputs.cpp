#include "nodes/visual_odometry/odometry_inputs.h"

#include <chrono>
#include <utility>

#include "ros/setup_checks.h"
#include "stereo_nav/ros/conversions.h"

namespace stereo_nav::nodes {
namespace {

constexpr double kLongestTick_s = 0.5;  // a longer interval was a pause
constexpr std::uint32_t kQueue = 20;    // callbacks are short; the queue only bridges load peaks
constexpr std::uint32_t kImuQueue = 500;
constexpr const char* kLeftRectified = "camera/left/image_rect";
constexpr const char* kRightRectified = "camera/right/image_rect";
constexpr const char* kDisparity = "camera/disparity";

ros::TransportHints transportHints() {
  return ros::TransportHints().tcpNoDelay();
}

std::string imuTopic(VisualOdometryParams::Imu imu) {
  return imu == VisualOdometryParams::Imu::kImu ? ros_io::topics::kImu : ros_io::topics::kImuQuaternion;
}

}  // namespace

OdometryInputs::OdometryInputs(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                               const VisualOdometryParams& params,
                               const ros_io::FrameSynchroniserParams& synchronisation, ros_io::Inbox& inbox,
                               Health& health)
    : handle_(handle),
      private_handle_(private_handle),
      params_(params),
      inbox_(inbox),
      health_(health),
      synchroniser_(synchronisation),
      clock_(kLongestTick_s),
      monitor_(params.input_timeout_s, clock_.seconds()),
      uses_disparity_(synchronisation.disparity != odometry::DisparityUse::kNone),
      image_transport_(handle_) {
  watchAll();
  subscribe();  // in a nodelet the first message may arrive while the next topic is being subscribed
}

std::size_t OdometryInputs::watch(const std::string& topic, bool stamped, const std::string& remedy,
                                  std::function<unsigned int()> publishers) {
  return monitor_.add({handle_.resolveName(topic), remedy, stamped, std::move(publishers)});
}

void OdometryInputs::watchAll() {
  const std::string rectify =
      "It comes from image_proc/rectify, which needs the raw image and its camera_info";
  const std::string driver = "The camera driver publishes it with each image";
  left_input_ = watch(kLeftRectified, true, rectify, [this] { return left_.getNumPublishers(); });
  right_input_ = watch(kRightRectified, true, rectify, [this] { return right_.getNumPublishers(); });
  if (uses_disparity_) {
    disparity_input_ =
        watch(kDisparity, true,
              "It comes from stereo_image_proc/disparity, which needs both rectified images and "
              "camera_infos with equal stamps (see image_proc.launch)",
              [this] { return disparity_.getNumPublishers(); });
  }
  left_info_input_ =
      watch(ros_io::topics::kLeftInfo, false, driver, [this] { return left_info_.getNumPublishers(); });
  right_info_input_ =
      watch(ros_io::topics::kRightInfo, false, driver, [this] { return right_info_.getNumPublishers(); });
  if (params_.imu != VisualOdometryParams::Imu::kNone) {
    imu_input_ =
        watch(imuTopic(params_.imu), false,
              "Rotation comes from the images alone until it runs. It comes from imu_bridge; without an IMU "
              "set the parameter `imu: none`",
              [this] { return imu_.getNumPublishers(); });
  }
}

void OdometryInputs::subscribe() {
  const image_transport::TransportHints image_hints("raw", transportHints(), private_handle_);
  left_ = image_transport_.subscribe(kLeftRectified, kQueue, &OdometryInputs::handleLeft, this, image_hints);
  right_ =
      image_transport_.subscribe(kRightRectified, kQueue, &OdometryInputs::handleRight, this, image_hints);
  if (uses_disparity_) {
    disparity_ =
        handle_.subscribe(kDisparity, kQueue, &OdometryInputs::handleDisparity, this, transportHints());
  }
  sync_ =
      handle_.subscribe(ros_io::topics::kSync, kQueue, &OdometryInputs::handleSync, this, transportHints());
  left_info_ = subscribeInfo(ros_io::topics::kLeftInfo, setup_.left_info, left_info_input_);
  right_info_ = subscribeInfo(ros_io::topics::kRightInfo, setup_.right_info, right_info_input_);
  subscribeImu();
}

ros::Subscriber OdometryInputs::subscribeInfo(const std::string& topic, sensor_msgs::CameraInfoConstPtr& slot,
                                              std::size_t input) {
  return handle_.subscribe<sensor_msgs::CameraInfo>(
      topic, kQueue,
      [this, &slot, input](const sensor_msgs::CameraInfoConstPtr& info) {
        monitor_.received(input, info->header.stamp, clock_.seconds());
        const std::lock_guard<std::mutex> lock(mutex_);
        slot = info;
      },
      ros::VoidConstPtr(), transportHints());
}

void OdometryInputs::subscribeImu() {
  switch (params_.imu) {
    case VisualOdometryParams::Imu::kNone:
      return;
    case VisualOdometryParams::Imu::kImu:
      imu_ = handle_.subscribe(imuTopic(params_.imu), kImuQueue, &OdometryInputs::handleImu, this,
                               transportHints());
      return;
    case VisualOdometryParams::Imu::kQuaternion:
      imu_ = handle_.subscribe(imuTopic(params_.imu), kImuQueue, &OdometryInputs::handleQuaternion, this,
                               transportHints());
      return;
  }
}

void OdometryInputs::handleLeft(const sensor_msgs::ImageConstPtr& image) {
  const auto arrival = std::chrono::steady_clock::now();
  monitor_.received(left_input_, image->header.stamp, clock_.seconds());
  {
    // Before the frame is passed on: its status counts it.
    const std::lock_guard<std::mutex> lock(mutex_);
    ++counts_.frames;
  }
  synchroniser_.addLeft(image, arrival);
  passOnFrames();
}

void OdometryInputs::handleRight(const sensor_msgs::ImageConstPtr& image) {
  monitor_.received(right_input_, image->header.stamp, clock_.seconds());
  synchroniser_.addRight(image);
  passOnFrames();
}

void OdometryInputs::handleDisparity(const stereo_msgs::DisparityImageConstPtr& disparity) {
  monitor_.received(disparity_input_, disparity->header.stamp, clock_.seconds());
  synchroniser_.addDisparity(disparity);
  passOnFrames();
}

void OdometryInputs::handleSync(const StereoSyncConstPtr& sync) {
  synchroniser_.addSync(sync);
  passOnFrames();
}

void OdometryInputs::passOnFrames() {
  while (auto frame = synchroniser_.take()) {
    monitor_.frameCompleted(clock_.seconds());
    inbox_.push(std::move(*frame));
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  counts_.dropped = synchroniser_.dropped() + inbox_.framesDropped();
}

void OdometryInputs::handleImu(const sensor_msgs::ImuConstPtr& imu) {
  monitor_.received(imu_input_, imu->header.stamp, clock_.seconds());
  addImuSample(ros_io::toImuSample(*imu), imu->header.frame_id);
}

void OdometryInputs::handleQuaternion(const geometry_msgs::QuaternionConstPtr& quaternion) {
  const ros::Time now = ros::Time::now();
  monitor_.received(imu_input_, now, clock_.seconds());
  ImuSample sample;
  sample.time_s = now.toSec();
  const Eigen::Quaterniond q(quaternion->w, quaternion->x, quaternion->y, quaternion->z);
  constexpr double kMinNorm = 0.1;
  if (q.norm() > kMinNorm) sample.q_world_imu = q.normalized();
  // The thesis' attitude is front-left-up, like the base's axes.
  addImuSample(sample, params_.base_frame);
}

void OdometryInputs::addImuSample(const ImuSample& sample, const std::string& frame_id) {
  const std::string frame = params_.imu_frame.empty() ? frame_id : params_.imu_frame;
  const bool holds_anything = sample.q_world_imu || sample.angular_velocity;
  if (frame.empty() || !holds_anything || !sample.isFinite()) {
    ++imu_refused_;
    health_.raise(
        "imu", false,
        frame.empty()
            ? "IMU messages carry no frame id, so that the mounting of the IMU is unknown; they are "
              "not used. Set the frame id in the driver, or the parameter imu_frame"
            : "IMU messages hold NaN, or neither orientation nor rates; they are not used. Look at "
              "`rostopic echo` of the topic, then at the driver");
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    setup_.imu_frame = frame;
  }
  inbox_.addImu(sample);
}

SensorSetup OdometryInputs::setup() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return setup_;
}

FrameCounts OdometryInputs::counts() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return counts_;
}

void OdometryInputs::report() {
  const double now_s = clock_.seconds();
  health_.replace("silent: ", true, monitor_.silentInputs(now_s));
  health_.replace("synchronisation", true, {{"", monitor_.unsynchronised(now_s)}});
  health_.replace("dropped frames", false, {{"", newDrops()}});
  health_.replace("calibration", true, {{"", calibrationProblem()}});
  health_.setCount("frames without late IMU", inbox_.framesWithoutImu());
  health_.setCount("IMU messages dropped", inbox_.imuDropped() + imu_refused_);
}

/// Said here as well as with the frames: of a pair that is refused no frame is rectified.
std::string OdometryInputs::calibrationProblem() {
  const SensorSetup now = setup();
  if (!now.left_info || !now.right_info) return "";
  const auto same = [](const sensor_msgs::CameraInfoConstPtr& a, const sensor_msgs::CameraInfoConstPtr& b) {
    return a && ros_io::sameCamera(*a, *b);
  };
  if (same(judged_setup_.left_info, now.left_info) && same(judged_setup_.right_info, now.right_info)) {
    return calibration_problem_;
  }
  judged_setup_ = now;
  calibration_problem_.clear();
  try {
    ros_io::judgeInfos(*now.left_info, *now.right_info);
  } catch (const std::exception& error) {
    calibration_problem_ = error.what();
  }
  return calibration_problem_;
}

std::string OdometryInputs::newDrops() {
  const std::uint64_t dropped = synchroniser_.dropped() + inbox_.framesDropped();
  const std::uint64_t since_last = dropped - std::exchange(dropped_reported_, dropped);
  if (since_last == 0) return "";
  return std::to_string(since_last) +
         " of the last second's frames were dropped: parts of them were lost on the way, or the computer is "
         "too slow for the cameras. Run the odometry as a nodelet, or lower rate or resolution";
}

}  // namespace stereo_nav::nodes
