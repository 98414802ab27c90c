#include "nodes/stereo_capture/stereo_capture_node.h"

#include <cmath>
#include <set>
#include <utility>

#include "core/rig_file.h"
#include "ros/judged_infos.h"
#include "ros/parameter_server.h"
#include "stereo_nav/StereoSync.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"

namespace stereo_nav::nodes {
namespace {

/// Names in the private namespace that are read elsewhere.
const std::set<std::string> kForeignParameters = {"disparity_config", "image_transport", "num_worker_threads",
                                                  "diagnostic_period"};

constexpr double kRepeat_s = 60.0;
constexpr std::int64_t kClockStep_ns = 10'000'000;

ros_io::CaptureSetup readSetup(const ros::NodeHandle& private_handle) {
  ros_io::CaptureSetup setup;
  setup.read({ros_io::fileSource(private_handle, "config"),
              ros_io::rigSource(private_handle, rig_sections::kCameras),
              ros_io::serverSource(private_handle, kForeignParameters)});
  return setup;
}

void writeLog(camera::Severity severity, const std::string& text) {
  if (severity == camera::Severity::kInfo) ROS_INFO_STREAM(text);
  if (severity == camera::Severity::kWarning) ROS_WARN_STREAM(text);
  if (severity == camera::Severity::kError) ROS_ERROR_STREAM(text);
}

ros::Time toRosTime(std::int64_t nanoseconds) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(nanoseconds));
}

}  // namespace

StereoCaptureNode::StereoCaptureNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : handle_(handle),
      private_handle_(private_handle),
      setup_(readSetup(private_handle_)),
      params_(setup_.params.capture),
      frame_id_(setup_.params.frame_id),
      left_publisher_(ros::NodeHandle(handle_, "camera/left"), "left", setup_.params.left.calibration,
                      frame_id_),
      right_publisher_(ros::NodeHandle(handle_, "camera/right"), "right", setup_.params.right.calibration,
                       frame_id_),
      sync_publisher_(handle_.advertise<StereoSync>(ros_io::topics::kSync, 10)),
      clock_([] { return camera::linuxKernel().monotonicNow(); },
             [] { return camera::linuxKernel().realtimeNow(); }),
      problems_(kRepeat_s),
      camera_(std::make_unique<camera::StereoCamera>(
          setup_.toConfig(), camera::linuxKernel(), camera::DeviceFinder(camera::linuxKernel()),
          [this](camera::StereoImages images) { publish(std::move(images)); }, writeLog)) {
  if (ros::Time::isSimTime()) {
    ROS_ERROR(
        "/use_sim_time is set, but live cameras stamp with this computer's clock: the stamps will not fit. "
        "Use `rosparam set /use_sim_time false` before starting any node");
  }
  CaptureDiagnostics::Sources sources;
  sources.status = [this] { return camera_->status(); };
  sources.calibration_problem = [this](camera::Side side) { return calibrationProblem(side); };
  sources.pair_problem = [this] { return pairProblem(); };
  sources.calibration_warning = [this](camera::Side side) { return publisherOf(side).calibrationWarning(); };
  for (const camera::Side side : {camera::Side::kLeft, camera::Side::kRight}) {
    const std::string warning = sources.calibration_warning(side);
    if (!warning.empty()) ROS_WARN_STREAM(warning);
  }
  sources.wanted_rate_hz = params_.rate_hz;
  diagnostics_ = std::make_unique<CaptureDiagnostics>(handle_, private_handle_, sources);
  if (setup_.params.load_image_proc) {
    image_proc_ =
        std::make_unique<ros_io::ImageProcLoader>(params_.stamps == camera::CaptureParams::Stamps::kCommon,
                                                  ros_io::readDisparityParams(private_handle_));
  }
  live_parameters_ = std::make_unique<ros_io::LiveParameters<ros_io::StereoCaptureParams>>(
      private_handle_, setup_.params,
      [this](const ros_io::StereoCaptureParams& params) { applyLive(params.capture); });
  camera_->start();
  timer_ = handle_.createWallTimer(ros::WallDuration(1.0), &StereoCaptureNode::handleTimer, this);
}

StereoCaptureNode::~StereoCaptureNode() {
  camera_->stop();
}

void StereoCaptureNode::publish(camera::StereoImages images) {
  followSystemClock();
  auto& [left, right] = images.pair;
  const ros::Time left_time = toRosTime(clock_.toRos(left.time_ns));
  const ros::Time right_time = toRosTime(clock_.toRos(right.time_ns));
  const bool common = params_.stamps == camera::CaptureParams::Stamps::kCommon;
  // camera/sync, which relates the images, is published first, so that no subscriber has to wait for it.
  publishSync(images, left_time, right_time);
  left_publisher_.publish(left, left_time);
  right_publisher_.publish(right, common ? left_time : right_time);
}

void StereoCaptureNode::publishSync(const camera::StereoImages& images, const ros::Time& left,
                                    const ros::Time& right) {
  const auto& pair = images.pair;
  StereoSync sync;
  sync.header.stamp = left;
  sync.header.frame_id = frame_id_;
  sync.left_stamp = left;
  sync.right_stamp = right;
  sync.skew_s = 1e-9 * static_cast<double>(pair.timeOffset_ns());
  sync.skew_rate = images.time_offset_rate;
  sync.left_sequence = pair.left.sequence;
  sync.right_sequence = pair.right.sequence;
  sync.left_lost = pair.left.lost;
  sync.right_lost = pair.right.lost;
  sync.pairs_dropped = images.pairs_dropped;
  sync.left_exposure_s = pair.left.exposure_s;
  sync.right_exposure_s = pair.right.exposure_s;
  sync.rolling_shutter_s = 1e-3 * params_.rolling_shutter_ms;
  sync_publisher_.publish(sync);
}

void StereoCaptureNode::followSystemClock() {
  const std::int64_t change_ns = clock_.measure();
  if (std::abs(change_ns) < kClockStep_ns) return;
  ROS_WARN("The system's clock was set by %.3f s; the images' stamps follow it",
           1e-9 * static_cast<double>(change_ns));
}

void StereoCaptureNode::applyLive(const camera::CaptureParams& params) {
  camera_->setMaxTimeOffset(params.max_time_offset_s);
  for (const auto& setting : camera::exposureControls(params.exposure_ms, params.gain)) {
    camera_->left().setControl(setting.name, setting.value);
    if (!params_.match_exposure) camera_->right().setControl(setting.name, setting.value);
  }
}

void StereoCaptureNode::handleTimer(const ros::WallTimerEvent&) {
  for (const camera::Side side : {camera::Side::kLeft, camera::Side::kRight}) {
    const std::string name = camera::sideName(side);
    tell(name, calibrationProblem(side), name + " camera: calibrated now");
  }
  tell("pair", pairProblem(), "the two calibrations are those of a stereo pair now");
  diagnostics_->update();
}

std::string StereoCaptureNode::pairProblem() {
  if (!calibrationProblem(camera::Side::kLeft).empty() || !calibrationProblem(camera::Side::kRight).empty())
    return {};
  try {
    ros_io::judgeInfos(left_publisher_.calibration(), right_publisher_.calibration());
    return {};
  } catch (const InputError& error) {
    return std::string("the calibrations of the two cameras: ") + error.what() +
           ". Raw images are published nevertheless, nothing is rectified";
  }
}

void StereoCaptureNode::tell(const std::string& key, const std::string& problem, const std::string& solved) {
  if (problem.empty()) {
    if (problems_.clear(key)) ROS_INFO_STREAM(solved);
  } else if (problems_.raise(key, false, problem, ros::WallTime::now().toSec())) {
    ROS_ERROR_STREAM(problem);
  }
}

}  // namespace stereo_nav::nodes
