#include "stereo_nav/nodes/stereo_capture_node.h"

#include <cmath>
#include <set>
#include <utility>

#include "stereo_nav/StereoSync.h"
#include "stereo_nav/ros_io/parameter_server.h"
#include "stereo_nav/ros_io/topics.h"

namespace stereo_nav::nodes {
namespace {

/// Names in the private namespace that are no fields of CaptureParams: text, maps, and those of libraries.
const std::set<std::string> kOtherParameters = {"left",
                                                "right",
                                                "controls",
                                                "frame_id",
                                                "load_image_proc",
                                                "image_transport",
                                                "num_worker_threads",
                                                "diagnostic_period"};

constexpr double kRepeat_s = 60.0;
constexpr std::int64_t kClockStep_ns = 10'000'000;

capture::CaptureParams readParams(const ros::NodeHandle& private_handle) {
  capture::CaptureParams params;
  ros_io::readParameters(private_handle, kOtherParameters, params);
  return params;
}

/// The map `controls` of both cameras and then that of this one, which wins.
std::vector<capture::ControlSetting> readControls(const ros::NodeHandle& private_handle,
                                                  const std::string& side) {
  std::vector<capture::ControlSetting> settings;
  for (const std::string& name : {std::string("controls"), side + "/controls"}) {
    const YAML::Node map = ros_io::parameterTree(ros::NodeHandle(private_handle, name));
    for (const auto& entry : map) {
      const auto control = entry.first.as<std::string>();
      try {
        // true and false are how YAML writes many switches.
        const auto value = entry.second.as<std::string>();
        const bool is_bool = value == "true" || value == "false";
        capture::setIn(settings,
                       {control, is_bool ? static_cast<int>(value == "true") : entry.second.as<int>()});
      } catch (const YAML::Exception&) {
        throw ParameterError("~" + name + "/" + control + " must be a whole number, true or false");
      }
    }
  }
  return settings;
}

std::string readDevice(const ros::NodeHandle& private_handle, const std::string& side) {
  std::string device;
  if (private_handle.getParam(side + "/device", device) && !device.empty()) return device;
  throw ParameterError("~" + side + "/device is not set: which is the " + side +
                       " camera? `rosrun stereo_nav list_cameras` shows the cameras and what to write");
}

capture::StereoConfig readConfig(const ros::NodeHandle& private_handle,
                                 const capture::CaptureParams& params) {
  capture::StereoConfig config = params.toConfig();
  for (capture::CameraConfig* camera : {&config.left, &config.right}) {
    camera->device = readDevice(private_handle, camera->name);
    camera->controls = readControls(private_handle, camera->name);
  }
  if (config.left.device == config.right.device) {
    throw ParameterError("~left/device and ~right/device are both " + config.left.device +
                         ": a stereo camera needs two");
  }
  return config;
}

void writeLog(capture::Severity severity, const std::string& text) {
  if (severity == capture::Severity::Info) ROS_INFO_STREAM(text);
  if (severity == capture::Severity::Warning) ROS_WARN_STREAM(text);
  if (severity == capture::Severity::Error) ROS_ERROR_STREAM(text);
}

ros::Time toRosTime(std::int64_t nanoseconds) {
  return ros::Time().fromNSec(static_cast<std::uint64_t>(nanoseconds));
}

}  // namespace

StereoCaptureNode::StereoCaptureNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : handle_(handle),
      private_handle_(private_handle),
      params_(readParams(private_handle_)),
      frame_id_(private_handle_.param<std::string>("frame_id", ros_io::frames::kLeftOptical)),
      left_publisher_(ros::NodeHandle(handle_, "camera/left"), "left",
                      private_handle_.param<std::string>("left/camera_info_url", ""), frame_id_),
      right_publisher_(ros::NodeHandle(handle_, "camera/right"), "right",
                       private_handle_.param<std::string>("right/camera_info_url", ""), frame_id_),
      sync_publisher_(handle_.advertise<StereoSync>(ros_io::topics::kSync, 10)),
      clock_([] { return capture::linuxKernel().monotonicNow(); },
             [] { return capture::linuxKernel().realtimeNow(); }),
      problems_(kRepeat_s),
      camera_(std::make_unique<capture::StereoCamera>(
          readConfig(private_handle_, params_), capture::linuxKernel(),
          capture::DeviceFinder(capture::linuxKernel()),
          [this](capture::StereoImages images) { publish(std::move(images)); }, writeLog)) {
  if (ros::Time::isSimTime()) {
    ROS_ERROR(
        "/use_sim_time is set, but live cameras stamp with this computer's clock: the stamps will not fit. "
        "Use "
        "`rosparam set /use_sim_time false` before starting any node");
  }
  CaptureDiagnostics::Sources sources;
  sources.status = [this] { return camera_->status(); };
  sources.calibration_problem = [this](capture::Side side) {
    return publisherOf(side).calibrationProblem(params_.width, params_.height);
  };
  sources.wanted_rate_hz = params_.rate_hz;
  diagnostics_ = std::make_unique<CaptureDiagnostics>(handle_, private_handle_, sources);
  if (private_handle_.param("load_image_proc", true)) {
    image_proc_ = std::make_unique<ImageProcLoader>(params_.stamps == capture::CaptureParams::Stamps::Common);
  }
  // Calls back at once with the parameters as they are.
  reconfigure_server_ = std::make_unique<dynamic_reconfigure::Server<StereoCaptureConfig>>(private_handle_);
  reconfigure_server_->setCallback(
      [this](const StereoCaptureConfig& config, std::uint32_t) { reconfigure(config); });
  camera_->start();
  timer_ = handle_.createWallTimer(ros::WallDuration(1.0), &StereoCaptureNode::handleTimer, this);
}

StereoCaptureNode::~StereoCaptureNode() {
  camera_->stop();
}

void StereoCaptureNode::publish(capture::StereoImages images) {
  followSystemClock();
  auto& [left, right] = images.pair;
  const ros::Time left_time = toRosTime(clock_.toRos(left.time_ns));
  const ros::Time right_time = toRosTime(clock_.toRos(right.time_ns));
  const bool common = params_.stamps == capture::CaptureParams::Stamps::Common;
  // First what says how the images belong together: then nobody has to wait for it.
  publishSync(images, left_time, right_time);
  left_publisher_.publish(left, left_time);
  right_publisher_.publish(right, common ? left_time : right_time);
}

void StereoCaptureNode::publishSync(const capture::StereoImages& images, const ros::Time& left,
                                    const ros::Time& right) {
  const auto& pair = images.pair;
  StereoSync sync;
  sync.header.stamp = left;
  sync.header.frame_id = frame_id_;
  sync.left_stamp = left;
  sync.right_stamp = right;
  sync.skew_s = 1e-9 * static_cast<double>(pair.skew_ns());
  sync.skew_rate = images.skew_rate;
  sync.left_sequence = pair.left.sequence;
  sync.right_sequence = pair.right.sequence;
  sync.left_lost = pair.left.lost;
  sync.right_lost = pair.right.lost;
  sync.pairs_dropped = images.pairs_dropped;
  sync.left_exposure_s = pair.left.exposure_s;
  sync.right_exposure_s = pair.right.exposure_s;
  sync_publisher_.publish(sync);
}

void StereoCaptureNode::followSystemClock() {
  const std::int64_t change_ns = clock_.measure();
  if (std::abs(change_ns) < kClockStep_ns) return;
  ROS_WARN("The system's clock was set by %.3f s; the images' stamps follow it",
           1e-9 * static_cast<double>(change_ns));
}

void StereoCaptureNode::reconfigure(const StereoCaptureConfig& config) {
  camera_->setMaxSkew(config.max_skew_s);
  for (const auto& setting : capture::exposureControls(config.exposure_ms, config.gain)) {
    camera_->left().setControl(setting.name, setting.value);
    if (!params_.match_exposure) camera_->right().setControl(setting.name, setting.value);
  }
}

void StereoCaptureNode::handleTimer(const ros::WallTimerEvent&) {
  tellCalibrationProblem(capture::Side::Left);
  tellCalibrationProblem(capture::Side::Right);
  diagnostics_->update();
}

void StereoCaptureNode::tellCalibrationProblem(capture::Side side) {
  const std::string problem = publisherOf(side).calibrationProblem(params_.width, params_.height);
  const std::string key = capture::sideName(side);
  if (problem.empty()) {
    if (problems_.clear(key)) ROS_INFO("%s camera: calibrated now", key.c_str());
  } else if (problems_.raise(key, false, problem, ros::WallTime::now().toSec())) {
    ROS_ERROR_STREAM(problem);
  }
}

}  // namespace stereo_nav::nodes
