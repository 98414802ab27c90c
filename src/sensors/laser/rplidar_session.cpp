#include "sensors/laser/rplidar_session.h"

#include <algorithm>

namespace stereo_nav::laser {
namespace {

using rplidar::Command;

/// The protocol asks for a millisecond after a stop; an adapter may hold old nodes for longer.
constexpr double kStop_s = 0.05;
constexpr double kReset_s = 2.0;
constexpr double kReply_s = 0.5;

std::size_t replyBytes(Command command) {
  if (command == Command::kGetInfo) return rplidar::kInfoBytes;
  return command == Command::kGetHealth ? rplidar::kHealthBytes : 0;
}

}  // namespace

void RplidarSession::begin(double now_s) {
  health_.reset();
  enter(Phase::kStopping, now_s);
}

void RplidarSession::enter(Phase phase, double now_s) {
  phase_ = phase;
  phase_start_s_ = now_s;
  reply_.clear();
  if (phase == Phase::kStopping) write_(Command::kStop);
  if (phase == Phase::kResetting) write_(Command::kReset);
  if (const auto command = awaited()) write_(*command);
}

/// The command whose reply is awaited.
std::optional<Command> RplidarSession::awaited() const {
  if (phase_ == Phase::kInfo) return Command::kGetInfo;
  if (phase_ == Phase::kHealth) return Command::kGetHealth;
  if (phase_ == Phase::kStarting) return Command::kScan;
  return std::nullopt;
}

std::size_t RplidarSession::update(const std::uint8_t* data, std::size_t size, double now_s) {
  std::size_t used = 0;
  while (used < size && !scanning()) {
    const std::uint8_t byte = data[used++];
    if (!awaited()) continue;
    reply_.push_back(byte);
    takeReply(now_s);
  }
  passTime(now_s);
  return used;
}

void RplidarSession::passTime(double now_s) {
  const double passed_s = now_s - phase_start_s_;
  if (phase_ == Phase::kStopping && passed_s > kStop_s) {
    enter(Phase::kInfo, now_s);
  } else if (phase_ == Phase::kResetting && passed_s > kReset_s) {
    enter(Phase::kStopping, now_s);
  } else if (awaited() && passed_s > kReply_s) {
    problem_ =
        "the scanner does not answer: is it an RPLiDAR A1, powered, and at the baud rate of this line? Its adapter "
        "needs the USB port's full current";
    enter(Phase::kStopping, now_s);
  }
}

/// Goes on when the reply that is awaited is complete; what is no part of it is left out.
void RplidarSession::takeReply(double now_s) {
  const Command command = *awaited();
  const rplidar::Descriptor descriptor = rplidar::descriptor(command);
  const auto begins_reply = [&] {
    const auto known = static_cast<std::ptrdiff_t>(std::min(reply_.size(), descriptor.size()));
    return std::equal(reply_.begin(), reply_.begin() + known, descriptor.begin());
  };
  while (!begins_reply()) reply_.erase(reply_.begin());
  if (reply_.size() < descriptor.size() + replyBytes(command)) return;
  const std::uint8_t* payload = reply_.data() + descriptor.size();
  if (command == Command::kGetInfo) {
    info_ = rplidar::decodeInfo(payload);
    enter(Phase::kHealth, now_s);
  } else if (command == Command::kGetHealth) {
    health_ = rplidar::decodeHealth(payload);
    judgeHealth(now_s);
  } else {
    enter(Phase::kScanning, now_s);
  }
}

void RplidarSession::judgeHealth(double now_s) {
  if (health_->status == DeviceHealth::Status::kError) {
    problem_ = "the scanner has stopped itself with error code " + std::to_string(health_->error_code) +
               " and was reset: does its head turn freely? If it persists, the device is defective";
    enter(Phase::kResetting, now_s);
    return;
  }
  problem_.clear();
  if (health_->status == DeviceHealth::Status::kWarning) {
    problem_ = "the scanner warns of error code " + std::to_string(health_->error_code) +
               ": it may stop itself soon; clean it and check that its head turns freely";
  }
  enter(Phase::kStarting, now_s);
}

}  // namespace stereo_nav::laser
