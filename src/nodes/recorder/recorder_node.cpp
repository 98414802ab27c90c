#include "nodes/recorder/recorder_node.h"

#include <rosbag/recorder.h>

#include <sstream>

#include "core/rig_file.h"
#include "nodes/recorder/recorded_topics.h"
#include "ros/parameter_server.h"

namespace stereo_nav::nodes {
namespace {

namespace fs = std::filesystem;

constexpr double kPeriod_s = 1.0;
constexpr double kRepeat_s = 30.0;
constexpr double kBytesPerGigabyte = 1e9;

RecorderParams readParams(const ros::NodeHandle& private_handle) {
  RecorderParams params;
  ros_io::readParameters({ros_io::serverSource(private_handle, {"diagnostic_period"})}, params);
  if (params.folder.empty()) throw ParameterError("~folder is not set: where are the recordings to go?");
  return params;
}

/// A section of the rig file, which names servos, range finders, switches and actuators.
template <class Params>
Params readSection(const ros::NodeHandle& private_handle, const char* section) {
  Params params;
  ros_io::readParameters({ros_io::rigSource(private_handle, section)}, params);
  return params;
}

std::vector<std::string> readTopics(const ros::NodeHandle& private_handle, const RecorderParams& params) {
  auto names =
      recordedTopics(readSection<ros_io::BaseBridgeParams>(private_handle, rig_sections::kBase),
                     readSection<ros_io::RangeBridgeParams>(private_handle, rig_sections::kRangeFinders),
                     params.more_topics);
  for (auto& name : names) name = ros::names::resolve(name);
  return names;
}

/// Absolute path of the folder, so that messages about it are clear: roslaunch starts nodes in ROS_HOME.
fs::path makeFolder(const RecorderParams& params) {
  fs::path folder = fs::absolute(params.folder);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw ParameterError("~folder " + folder.string() + " cannot be created: " + error.message());
  const auto space = fs::space(folder, error);
  const double free_gb = static_cast<double>(space.available) / kBytesPerGigabyte;
  if (!error && free_gb < params.reserve_gb) {
    std::ostringstream text;
    text << "~folder " << folder.string() << " has " << free_gb
         << " GB free, less than ~reserve_gb = " << params.reserve_gb
         << "; delete old recordings or record to another disk";
    throw ParameterError(text.str());
  }
  return folder;
}

std::uint64_t toBytes(double gigabytes) {
  return static_cast<std::uint64_t>(gigabytes * kBytesPerGigabyte);
}

}  // namespace

void RecorderParams::describe(ParameterVisitor& visitor) {
  visitor.text("folder", folder, "folder for the bags; created if it does not exist");
  visitor.text("prefix", prefix, "how the bags' names begin; date, time and number follow");
  visitor.text("more_topics", more_topics, "topics to record besides the sensors, separated by commas");
  visitor.integer("split_mb", split_mb, {16, 1000000}, "MB",
                  "a bag of this size is closed and the next one begins");
  visitor.integer("buffer_mb", buffer_mb, {16, 100000}, "MB", "memory for messages that wait to be written");
  visitor.real("reserve_gb", reserve_gb, {0.01, 10000.0}, "GB",
               "space that is left free on the disk: recording stops when it is reached");
  visitor.real("warn_before_min", warn_before_min, {0.1, 1440.0}, "min",
               "warn when the disk will be full in less than this time");
}

RecorderNode::RecorderNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : handle_(handle),
      params_(readParams(private_handle)),
      topics_(readTopics(private_handle, params_)),
      folder_(makeFolder(params_)),
      bytes_before_(recordedBytes()),
      disk_(toBytes(params_.reserve_gb), 60.0 * params_.warn_before_min),
      updater_(handle_, private_handle) {
  updater_.setHardwareID("none");
  updater_.add("recording", this, &RecorderNode::fillStatus);
  timer_ = handle_.createWallTimer(ros::WallDuration(kPeriod_s), &RecorderNode::watch, this);
}

int RecorderNode::run() {
  constexpr unsigned int kMebi = 1024 * 1024;
  rosbag::RecorderOptions options;
  options.prefix = (folder_ / params_.prefix).string();
  options.topics = topics_;
  options.split = true;
  options.max_size = static_cast<std::uint64_t>(params_.split_mb) * kMebi;
  options.buffer_size = static_cast<std::uint32_t>(params_.buffer_mb) * kMebi;
  options.min_space = toBytes(params_.reserve_gb);
  options.min_space_str = std::to_string(params_.reserve_gb) + "G";
  options.repeat_latched = true;  // each bag can be used alone: tf_static is in all of them
  options.transport_hints.tcpNoDelay();
  rosbag::Recorder recorder(options);
  return recorder.run();
}

/// Size of all recordings with this prefix. A bag may be renamed while the folder is read.
std::uint64_t RecorderNode::recordedBytes() const {
  std::uint64_t bytes = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    if (entry.path().filename().string().compare(0, params_.prefix.size(), params_.prefix) != 0) continue;
    const auto size = entry.file_size(error);
    if (!error) bytes += size;
  }
  return bytes;
}

void RecorderNode::watch(const ros::WallTimerEvent& /*event*/) {
  std::error_code error;
  const auto space = fs::space(folder_, error);
  if (error) {
    unreadable_ = "the folder " + folder_.string() + " cannot be read: " + error.message() +
                  "; was its disk unplugged, or the folder removed?";
    updater_.update();
    ROS_ERROR_STREAM_THROTTLE(kRepeat_s, unreadable_);
    return;
  }
  unreadable_.clear();
  const std::uint64_t bytes = recordedBytes();
  const ros::WallTime now = ros::WallTime::now();
  disk_.add(now.toSec(), bytes - std::min(bytes, bytes_before_), space.available);
  updater_.update();

  const DiskWatch::State state = disk_.state();
  if (state == DiskWatch::State::kStarting) return;
  if (state == said_ && (now - said_at_).toSec() < kRepeat_s) return;
  said_ = state;
  said_at_ = now;
  if (state == DiskWatch::State::kGood) ROS_INFO_STREAM(disk_.text());
  if (state == DiskWatch::State::kLow || state == DiskWatch::State::kSilent) ROS_WARN_STREAM(disk_.text());
  if (state == DiskWatch::State::kFull) ROS_ERROR_STREAM(disk_.text());
}

void RecorderNode::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  const DiskWatch::State state = disk_.state();
  const bool good = state == DiskWatch::State::kGood || state == DiskWatch::State::kStarting;
  status.summary(good                               ? Level::OK
                 : state == DiskWatch::State::kFull ? Level::ERROR
                                                    : Level::WARN,
                 disk_.text());
  status.add("folder", folder_.string());
  if (!unreadable_.empty()) status.summary(Level::ERROR, unreadable_);
  status.addf("rate [MB/s]", "%.2f", disk_.rate() / 1e6);
  status.addf("written [MB]", "%.1f", static_cast<double>(disk_.bytesWritten()) / 1e6);
  status.addf("free [GB]", "%.2f", static_cast<double>(disk_.bytesFree()) / 1e9);
  if (const auto left = disk_.secondsLeft()) status.addf("lasts [min]", "%.1f", *left / 60.0);
}

}  // namespace stereo_nav::nodes
