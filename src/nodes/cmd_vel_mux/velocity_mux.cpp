#include "nodes/cmd_vel_mux/velocity_mux.h"

#include <utility>

namespace stereo_nav::nodes {

VelocityMux::VelocityMux(std::vector<VelocitySource> sources)
    : sources_(std::move(sources)),
      heard_s_(sources_.size()),
      dropped_(sources_.size()),
      passed_(sources_.size()) {}

bool VelocityMux::offer(std::size_t source, double now_s) {
  heard_s_[source] = now_s;
  const bool passes = active(now_s) == source;
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
