#include "sensors/serial/frame_link.h"

#include <sstream>
#include <utility>

namespace stereo_nav::serial {
namespace {

/// Time over which rate and jitters are measured.
constexpr double kReportPeriod_s = 5.0;

}  // namespace

std::string explain(const LinkStatus& link, const LinkWords& words) {
  switch (link.state) {
    case LinkState::kDisconnected:
      return link.fault;
    case LinkState::kWaiting:
      return words.waiting;
    case LinkState::kSilent: {
      std::ostringstream text;
      text.precision(3);
      text << words.silence << " " << link.silent_s << " s" << words.silent;
      return text.str();
    }
    case LinkState::kNoFrames:
      return words.no_frames;
    case LinkState::kStreaming:
      break;
  }
  return words.streaming;
}

FrameLink::FrameLink(const LinkParams& params, const StampFilterParams& stamps, Link::Open open)
    : stamps_(stamps), link_(params, [this, open = std::move(open)] {
        auto source = open();
        stamps_.reset();
        const std::lock_guard<std::mutex> lock(mutex_);
        jitter_.restart();
        return source;
      }) {}

double FrameLink::stamp(double device_clock, double step, double arrival_s) {
  const double sent_s = stamps_.stamp(device_clock, step, arrival_s);
  link_.delivered();
  const std::lock_guard<std::mutex> lock(mutex_);
  jitter_.add(arrival_s, sent_s, device_clock);
  if (jitter_.duration_s() > kReportPeriod_s) {
    report_.rate_hz = jitter_.rate_hz();
    report_.arrival_jitter_s = jitter_.arrivalJitter_s();
    report_.stamp_jitter_s = jitter_.stampJitter_s();
    jitter_.restart();
  }
  return sent_s;
}

DeviceStatus FrameLink::status(const LinkWords& words) const {
  const LinkStatus link = link_.status();
  const std::lock_guard<std::mutex> lock(mutex_);
  DeviceStatus status = report_;
  status.state = link.state;
  status.connections = link.connections;
  status.message = explain(link, words);
  if (link.state != LinkState::kStreaming)
    status.rate_hz = status.arrival_jitter_s = status.stamp_jitter_s = 0.0;
  return status;
}

}  // namespace stereo_nav::serial
