#include "nodes/visual_odometry/health.h"

#include <ros/console.h>

#include <chrono>
#include <vector>

namespace stereo_nav::nodes {
namespace {

constexpr double kRepeat_s = 10.0;

double steadySeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

const char* nameOf(odometry::State state) {
  switch (state) {
    case odometry::State::kInitialising:
      return "INITIALISING";
    case odometry::State::kTracking:
      return "TRACKING";
    case odometry::State::kCoasting:
      return "COASTING";
    case odometry::State::kLost:
      return "LOST";
  }
  return "unknown";
}

}  // namespace

Health::Health(ros::NodeHandle& handle, ros::NodeHandle& private_handle, const std::string& name)
    : name_(name), problems_(kRepeat_s), updater_(handle, private_handle, name) {
  updater_.setHardwareID("none");
  updater_.add("odometry", this, &Health::fillStatus);
}

void Health::raise(const std::string& key, bool is_error, const std::string& text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!problems_.raise(key, is_error, text, steadySeconds())) return;
  if (is_error) {
    ROS_ERROR_STREAM(name_ << ": " << text);
  } else {
    ROS_WARN_STREAM(name_ << ": " << text);
  }
}

void Health::clear(const std::string& key) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (problems_.clear(key)) ROS_INFO_STREAM(name_ << ": over: " << key);
}

void Health::replace(const std::string& family, bool is_error,
                     const std::map<std::string, std::string>& texts) {
  std::vector<std::string> ended;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& problem : problems_.all()) {
      if (problem.first.compare(0, family.size(), family) != 0) continue;
      const auto still = texts.find(problem.first.substr(family.size()));
      if (still == texts.end() || still->second.empty()) ended.push_back(problem.first);
    }
  }
  for (const auto& key : ended) clear(key);
  for (const auto& text : texts) {
    if (!text.second.empty()) raise(family + text.first, is_error, text.second);
  }
}

void Health::frameDone(const SessionOutput& output, const FrameCounts& counts, double latency_ms) {
  const std::lock_guard<std::mutex> lock(mutex_);
  processed_ = output.processed;
  counts_ = counts;
  last_ = output.result;
  last_.features.clear();
  if (output.processed) latency_ms_.add(latency_ms);
}

void Health::setCount(const std::string& name, std::uint64_t count) {
  const std::lock_guard<std::mutex> lock(mutex_);
  more_counts_[name] = count;
}

void Health::fillStatus(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  using Level = diagnostic_msgs::DiagnosticStatus;
  if (!processed_) {
    status.summary(Level::ERROR, "no odometry yet");
  } else if (last_.state == odometry::State::kLost) {
    status.summary(Level::WARN, "lost: " + last_.reason);
  } else if (last_.state == odometry::State::kCoasting) {
    status.summary(Level::WARN, "coasting on the last velocity: " + last_.reason);
  } else {
    status.summary(Level::OK, nameOf(last_.state));
  }
  for (const auto& problem : problems_.all()) {
    status.mergeSummary(problem.second.is_error ? Level::ERROR : Level::WARN, problem.second.text);
  }
  status.add("state", processed_ ? nameOf(last_.state) : "WAITING");
  status.add("features detected", last_.features_detected);
  status.add("inliers", last_.inliers);
  status.add("frames", counts_.frames);
  status.add("frames dropped", counts_.dropped);
  status.add("frames lost", counts_.lost);
  for (const auto& count : more_counts_) status.add(count.first, count.second);
  status.add("latency samples", latency_ms_.size());
  status.addf("latency median [ms]", "%.1f", latency_ms_.quantile(0.5));
  status.addf("latency p95 [ms]", "%.1f", latency_ms_.quantile(0.95));
}

}  // namespace stereo_nav::nodes
