#include "nodes/cmd_vel_mux/velocity_mux.h"

#include <utility>

namespace stereo_nav::nodes {

VelocityMux::VelocityMux(std::vector<VelocitySource> sources)
    : sources_(std::move(sources)),
      heard_s_(sources_.size()),
      dropped_(sources_.size()),
      passed_(sources_.size()) {}

double VelocityMux::tick(double now_s) {
  const double pause_s = guard_.tick(now_s);
  if (pause_s > 0.0) {
    for (std::size_t i = 0; i < sources_.size(); ++i)
      if (!sources_[i].stops) heard_s_[i].reset();
  }
  return pause_s;
}

bool VelocityMux::offer(std::size_t source, double now_s) {
  const bool believed = sources_[source].stops || !guard_.blocks(now_s);
  if (believed) heard_s_[source] = now_s;
  const bool passes = believed && active(now_s) == source;
  ++(passes ? passed_ : dropped_)[source];
  return passes;
}

std::optional<std::size_t> VelocityMux::active(double now_s) const {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    if (heard_s_[i] && now_s - *heard_s_[i] < sources_[i].timeout_s) return i;
  }
  return std::nullopt;
}

}  // namespace stereo_nav::nodes
