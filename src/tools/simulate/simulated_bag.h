#pragma once

#include <functional>
#include <string>

#include "ros/simulated_messages.h"

namespace stereo_nav::tools {

/// ROS time of simulation time 0. Any date will do; a fixed one gives the same bytes every time.
inline const ros::Time kBagStart(1000000000, 0);

struct SimulatedBagOptions {
  double duration_s;
  int threads;
  bool images;
  bool compress;
};

/// Writes all messages of a simulation in order of their arrival. `progress(done, all)` counts pairs. Pairs
/// are rendered on several threads; the bytes do not depend on how many. Throws InputError when the
/// bag cannot be written.
void writeSimulatedBag(const std::string& path, const sim::Simulation& simulation,
                       const SimulatedBagOptions& options,
                       const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace stereo_nav::tools
