#include "stereo_nav/nodes/visual_odometry_node.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stereo_nav/ros_io/conversions.h"
#include "stereo_nav/ros_io/parameter_server.h"

namespace stereo_nav::nodes {
namespace {

/// Names in the private namespace that belong to others.
const std::set<std::string> kForeignParameters = {"vo", "image_transport", "diagnostic_period"};

constexpr double kTimerPeriod_s = 0.25;
constexpr unsigned int kTicksPerReport = 4;

VisualOdometryParams readNodeParams(const ros::NodeHandle& private_handle) {
  VisualOdometryParams params;
  ros_io::readParameters({ros_io::serverSource(private_handle, kForeignParameters)}, params);
  params.waiting.wait_for_imu = params.imu != VisualOdometryParams::Imu::kNone;
  return params;
}

vo::OdometryConfig readOdometryConfig(const ros::NodeHandle& private_handle) {
  vo::OdometryConfig config;
  ros_io::readParameters({ros_io::fileSource(private_handle, "config"),
                          ros_io::serverSource(ros::NodeHandle(private_handle, "vo"))},
                         config);
  return config;
}

/// Asks the odometry itself whether it wants the map; which calibration it would run with plays no part in
/// that.
FrameSynchroniserParams::Disparity disparityUse(const vo::OdometryConfig& config) {
  vo::StereoCalibration any;
  any.fx = any.fy = any.baseline_m = 1.0;
  any.width = any.height = 1;
  if (!vo::makeOdometry(config, any, Eigen::Matrix3d::Identity())->usesDisparityMap()) {
    return FrameSynchroniserParams::Disparity::kNone;
  }
  const bool latest =
      config.method == vo::Method::kThesis && config.thesis.disparity == vo::ThesisParams::Disparity::kLatest;
  return latest ? FrameSynchroniserParams::Disparity::kLatest : FrameSynchroniserParams::Disparity::kMatched;
}

FrameSynchroniserParams synchroniserParams(FrameSynchroniserParams params, const vo::OdometryConfig& config) {
  params.disparity = disparityUse(config);
  return params;
}

/// Waits a moment, once: transforms and first images of a bag come together, and the first frame is the
/// origin.
TransformLookup lookupIn(tf2_ros::Buffer& buffer) {
  constexpr int kTries = 20;
  return [&buffer, tries_left = kTries](const std::string& target, const std::string& source,
                                        std::string& error) mutable -> std::optional<Eigen::Isometry3d> {
    for (; tries_left > 0 && !buffer.canTransform(target, source, ros::Time(0)); --tries_left) {
      ros::WallDuration(0.01).sleep();  // the ROS clock may stand still
    }
    try {
      return ros_io::toIsometry(buffer.lookupTransform(target, source, ros::Time(0)).transform);
    } catch (const tf2::TransformException& exception) {
      error = exception.what();
      return std::nullopt;
    }
  };
}

bool isFinite(const vo::ImuSample& sample) {
  return (!sample.q_world_imu || sample.q_world_imu->coeffs().allFinite()) &&
         (!sample.angular_velocity || sample.angular_velocity->allFinite()) &&
         (!sample.linear_acceleration || sample.linear_acceleration->allFinite());
}

/// Whether stamps follow the running clock of this host, i.e. are not those of a replay.
bool isLive(const ros::Time& stamp) {
  constexpr double kLive_s = 5.0;
  return !ros::Time::isSimTime() && std::abs((ros::Time::now() - stamp).toSec()) < kLive_s;
}

}  // namespace

VisualOdometryNode::VisualOdometryNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                                       const std::string& name)
    : handle_(handle),
      private_handle_(private_handle),
      name_(name),
      params_(readNodeParams(private_handle_)),
      tf_listener_(tf_buffer_),
      health_(handle_, private_handle_, name),
      synchroniser_(synchroniserParams(params_.synchronisation, readOdometryConfig(private_handle_))),
      last_steady_time_(std::chrono::steady_clock::now()),
      inbox_(params_.waiting),
      session_(params_, readOdometryConfig(private_handle_), lookupIn(tf_buffer_)),
      publisher_(handle_, params_),
      disparity_view_(handle_),
      image_transport_(handle_) {
  monitor_ = std::make_unique<InputMonitor>(params_.input_timeout_s, watchedSeconds());
  worker_ = std::thread(&VisualOdometryNode::work, this);
  reset_service_ = handle_.advertiseService("vo/reset", &VisualOdometryNode::handleReset, this);
  set_pose_service_ = handle_.advertiseService("vo/set_pose", &VisualOdometryNode::handleSetPose, this);
  subscribe();
  offerReconfiguration();
  timer_ = handle_.createWallTimer(ros::WallDuration(kTimerPeriod_s), &VisualOdometryNode::handleTimer, this);
}

VisualOdometryNode::~VisualOdometryNode() {
  inbox_.stop();
  worker_.join();
}

/// Both call back at once with the parameters as they are, which they take from the server.
void VisualOdometryNode::offerReconfiguration() {
  ros_io::writeParameters(private_handle_, params_);
  reconfigure_server_ = std::make_unique<dynamic_reconfigure::Server<VisualOdometryConfig>>(private_handle_);
  reconfigure_server_->setCallback([this](const VisualOdometryConfig& config, std::uint32_t) {
    monitor_->setTimeout(config.input_timeout_s);
    const std::lock_guard<std::mutex> lock(session_mutex_);
    publisher_.setLive(config.publish_tf, config.path_spacing_m);
  });
  uncertainty_server_ = std::make_unique<dynamic_reconfigure::Server<UncertaintyConfig>>(
      ros::NodeHandle(private_handle_, "uncertainty"));
  uncertainty_server_->setCallback([this](const UncertaintyConfig& config, std::uint32_t) {
    UncertaintyParams uncertainty;
    uncertainty.min_translation_sigma_m = config.min_translation_sigma_m;
    uncertainty.min_rotation_sigma_rad = config.min_rotation_sigma_rad;
    uncertainty.lost_speed_m_s = config.lost_speed_m_s;
    uncertainty.lost_turn_rate_rad_s = config.lost_turn_rate_rad_s;
    const std::lock_guard<std::mutex> lock(session_mutex_);
    session_.setUncertainty(uncertainty);
  });
}

std::size_t VisualOdometryNode::watch(const std::string& topic, bool stamped, const std::string& remedy,
                                      std::function<unsigned int()> publishers) {
  return monitor_->add({handle_.resolveName(topic), remedy, stamped, std::move(publishers)});
}

void VisualOdometryNode::subscribe() {
  constexpr std::uint32_t kQueue = 20;  // callbacks are short; this only bridges a busy moment
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  const image_transport::TransportHints image_hints("raw", hints, private_handle_);
  const std::string rectify =
      "It comes from image_proc/rectify, which needs the raw image and its camera_info";

  left_subscriber_ = image_transport_.subscribe("camera/left/image_rect", kQueue,
                                                &VisualOdometryNode::handleLeft, this, image_hints);
  left_input_ =
      watch("camera/left/image_rect", true, rectify, [this] { return left_subscriber_.getNumPublishers(); });
  right_subscriber_ = image_transport_.subscribe("camera/right/image_rect", kQueue,
                                                 &VisualOdometryNode::handleRight, this, image_hints);
  right_input_ = watch("camera/right/image_rect", true, rectify,
                       [this] { return right_subscriber_.getNumPublishers(); });

  if (disparityUse(readOdometryConfig(private_handle_)) != FrameSynchroniserParams::Disparity::kNone) {
    disparity_subscriber_ =
        handle_.subscribe("camera/disparity", kQueue, &VisualOdometryNode::handleDisparity, this, hints);
    disparity_input_ =
        watch("camera/disparity", true,
              "It comes from stereo_image_proc/disparity, which needs both rectified images and "
              "camera_infos with equal stamps (see image_proc.launch)",
              [this] { return disparity_subscriber_.getNumPublishers(); });
  }
  sync_subscriber_ = handle_.subscribe("camera/sync", kQueue, &VisualOdometryNode::handleSync, this, hints);

  const auto subscribeInfo = [&](const std::string& topic, ros::Subscriber& subscriber,
                                 sensor_msgs::CameraInfoConstPtr& slot) {
    const std::size_t input = watch(topic, false, "The camera driver publishes it with each image",
                                    [&subscriber] { return subscriber.getNumPublishers(); });
    subscriber = handle_.subscribe<sensor_msgs::CameraInfo>(
        topic, kQueue,
        [this, &slot, input](const sensor_msgs::CameraInfoConstPtr& info) { handleInfo(slot, input, info); },
        ros::VoidConstPtr(), hints);
  };
  subscribeInfo("camera/left/camera_info", left_info_subscriber_, setup_.left_info);
  subscribeInfo("camera/right/camera_info", right_info_subscriber_, setup_.right_info);
  subscribeImu();
}

void VisualOdometryNode::subscribeImu() {
  constexpr std::uint32_t kImuQueue = 500;
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  std::string topic;
  switch (params_.imu) {
    case VisualOdometryParams::Imu::kNone:
      return;
    case VisualOdometryParams::Imu::kImu:
      topic = ros_io::topics::kImu;
      imu_subscriber_ = handle_.subscribe(topic, kImuQueue, &VisualOdometryNode::handleImu, this, hints);
      break;
    case VisualOdometryParams::Imu::kQuaternion:
      topic = ros_io::topics::kImuQuaternion;
      imu_subscriber_ =
          handle_.subscribe(topic, kImuQueue, &VisualOdometryNode::handleQuaternion, this, hints);
      break;
  }
  imu_input_ = watch(
      topic, false,
      "Rotation comes from the images alone until it runs. It comes from imu_bridge; without an IMU set "
      "the parameter `imu: none`",
      [this] { return imu_subscriber_.getNumPublishers(); });
}

void VisualOdometryNode::handleLeft(const sensor_msgs::ImageConstPtr& image) {
  const auto arrival = std::chrono::steady_clock::now();
  monitor_->received(left_input_, image->header.stamp, watchedSeconds());
  ++lefts_received_;
  synchroniser_.addLeft(image, arrival);
  passOnFrames();
}

void VisualOdometryNode::handleRight(const sensor_msgs::ImageConstPtr& image) {
  monitor_->received(right_input_, image->header.stamp, watchedSeconds());
  synchroniser_.addRight(image);
  passOnFrames();
}

void VisualOdometryNode::handleDisparity(const stereo_msgs::DisparityImageConstPtr& disparity) {
  monitor_->received(disparity_input_, disparity->header.stamp, watchedSeconds());
  synchroniser_.addDisparity(disparity);
  passOnFrames();
}

void VisualOdometryNode::handleSync(const StereoSyncConstPtr& sync) {
  synchroniser_.addSync(sync);
  passOnFrames();
}

void VisualOdometryNode::passOnFrames() {
  while (auto frame = synchroniser_.take()) {
    monitor_->frameCompleted(watchedSeconds());
    inbox_.push(std::move(*frame));
  }
  const std::lock_guard<std::mutex> lock(setup_mutex_);
  counts_.frames = lefts_received_;
  counts_.dropped = synchroniser_.dropped() + inbox_.framesDropped();
}

void VisualOdometryNode::handleInfo(sensor_msgs::CameraInfoConstPtr& slot, std::size_t input,
                                    const sensor_msgs::CameraInfoConstPtr& info) {
  monitor_->received(input, info->header.stamp, watchedSeconds());
  const std::lock_guard<std::mutex> lock(setup_mutex_);
  slot = info;
}

void VisualOdometryNode::handleImu(const sensor_msgs::ImuConstPtr& imu) {
  monitor_->received(imu_input_, imu->header.stamp, watchedSeconds());
  addImuSample(ros_io::toImuSample(*imu), imu->header.frame_id);
}

void VisualOdometryNode::handleQuaternion(const geometry_msgs::QuaternionConstPtr& quaternion) {
  const ros::Time now = ros::Time::now();
  monitor_->received(imu_input_, now, watchedSeconds());
  vo::ImuSample sample;
  sample.time_s = now.toSec();
  const Eigen::Quaterniond q(quaternion->w, quaternion->x, quaternion->y, quaternion->z);
  constexpr double kMinNorm = 0.1;
  if (q.norm() > kMinNorm) sample.q_world_imu = q.normalized();
  // The thesis' attitude is front-left-up, as the base's axes.
  addImuSample(sample, params_.base_frame);
}

void VisualOdometryNode::addImuSample(const vo::ImuSample& sample, const std::string& frame_id) {
  const std::string frame = params_.imu_frame.empty() ? frame_id : params_.imu_frame;
  const bool holds_anything = sample.q_world_imu || sample.angular_velocity;
  if (frame.empty() || !holds_anything || !isFinite(sample)) {
    ++imu_refused_;
    health_.raise("imu", false,
                  frame.empty()
                      ? "IMU messages carry no frame id, so that nobody can say how the IMU is mounted; they "
                        "are not used. Set it in the driver, or the parameter imu_frame"
                      : "IMU messages hold NaN, or neither orientation nor rates; they are not used. Look at "
                        "`rostopic echo` of the topic, then at the driver");
    return;
  }
  {
    const std::lock_guard<std::mutex> lock(setup_mutex_);
    setup_.imu_frame = frame;
  }
  inbox_.addImu(sample);
}

bool VisualOdometryNode::handleReset(std_srvs::Empty::Request&, std_srvs::Empty::Response&) {
  const std::lock_guard<std::mutex> lock(session_mutex_);
  session_.reset();
  publisher_.forgetPath();
  ROS_INFO_STREAM(name_ << ": reset on request; the next frame is the origin");
  return true;
}

bool VisualOdometryNode::handleSetPose(SetPose::Request& request, SetPose::Response& response) {
  const auto& pose = request.pose.pose.pose;
  const Eigen::Quaterniond q(pose.orientation.w, pose.orientation.x, pose.orientation.y, pose.orientation.z);
  const Eigen::Vector3d position(pose.position.x, pose.position.y, pose.position.z);
  const vo::Matrix6d covariance =
      Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(request.pose.pose.covariance.data());
  constexpr double kUnitNorm = 0.01;
  const std::string& frame = request.pose.header.frame_id;
  if (!frame.empty() && frame != params_.odom_frame) {
    response.message = "the pose is in frame '" + frame + "', it must be in '" + params_.odom_frame + "'";
  } else if (!position.allFinite() || !covariance.allFinite() || !(std::abs(q.norm() - 1.0) < kUnitNorm)) {
    response.message = "position and covariance must be numbers, the orientation a quaternion of norm 1";
  } else {
    Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
    T_odom_base.linear() = q.normalized().toRotationMatrix();
    T_odom_base.translation() = position;
    const std::lock_guard<std::mutex> lock(session_mutex_);
    response.success = static_cast<std::uint8_t>(session_.setPose(T_odom_base, covariance));
    if (response.success == 0) response.message = "no odometry yet: it still waits for its inputs";
  }
  if (response.success == 0) ROS_ERROR_STREAM(name_ << ": vo/set_pose refused: " << response.message);
  return true;
}

void VisualOdometryNode::handleTimer(const ros::WallTimerEvent&) {
  const double now_s = watchedSeconds();
  if (++ticks_ % kTicksPerReport != 0) return;
  health_.replace("silent: ", true, monitor_->silentInputs(now_s));
  health_.replace("synchronisation", true, {{"", monitor_->unsynchronised(now_s)}});
  health_.replace("dropped frames", false, {{"", newDrops()}});
  health_.setCount("frames without late IMU", inbox_.framesWithoutImu());
  health_.setCount("IMU messages dropped", inbox_.imuDropped() + imu_refused_);
  health_.publishDiagnostics();
}

std::string VisualOdometryNode::newDrops() {
  const std::uint64_t dropped = synchroniser_.dropped() + inbox_.framesDropped();
  const std::uint64_t since_last = dropped - std::exchange(dropped_reported_, dropped);
  if (since_last == 0) return "";
  return std::to_string(since_last) +
         " of the last second's frames were dropped: parts of them were lost on the way, or the computer is "
         "too slow "
         "for the cameras. Run the odometry as a nodelet, or lower rate or resolution";
}

double VisualOdometryNode::watchedSeconds() {
  // A paused replay is no silence: time counts only while the ROS clock moves.
  const auto steady_now = std::chrono::steady_clock::now();
  if (ros::Time::isSimTime()) {
    const ros::Time ros_now = ros::Time::now();
    if (ros_now == last_ros_time_) return watched_s_;
    last_ros_time_ = ros_now;
  }
  constexpr double kLongestTick_s = 2.0 * kTimerPeriod_s;  // anything longer was a pause
  const std::chrono::duration<double> elapsed = steady_now - last_steady_time_;
  watched_s_ += std::min(elapsed.count(), kLongestTick_s);
  last_steady_time_ = steady_now;
  return watched_s_;
}

void VisualOdometryNode::work() {
  while (const auto work = inbox_.waitAndTake()) {
    try {
      processFrame(*work);
    } catch (const std::exception& error) {
      // One frame must not end the process, least of all a manager that other nodelets live in.
      ROS_ERROR_STREAM(name_ << ": frame " << work->frame.left_stamp << " given up: " << error.what());
    }
  }
}

void VisualOdometryNode::processFrame(const Inbox::Work& work) {
  SensorSetup setup;
  FrameCounts counts;
  {
    const std::lock_guard<std::mutex> lock(setup_mutex_);
    setup = setup_;
    counts = counts_;
  }
  SessionOutput output;
  {
    const std::lock_guard<std::mutex> lock(session_mutex_);
    output = session_.process(work, setup, isLive(work.frame.left_stamp));
    counts.lost = session_.framesLost();
    if (work.frame.after_jump) publisher_.forgetPath();
    publisher_.publish(work.frame, output, counts);
  }
  const std::chrono::duration<double, std::milli> latency =
      std::chrono::steady_clock::now() - work.frame.arrival;
  for (const auto& note : output.notes) ROS_INFO_STREAM(name_ << ": " << note);
  for (const auto& announcement : output.announcements) ROS_WARN_STREAM(name_ << ": " << announcement);
  health_.replace("setup: ", true, output.errors);
  health_.replace("quality: ", false, output.warnings);
  health_.frameDone(output, counts, latency.count());
}

}  // namespace stereo_nav::nodes
