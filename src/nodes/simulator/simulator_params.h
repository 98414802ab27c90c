#pragma once

#include <string>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::nodes {

/// Private parameters of the simulator.
struct SimulatorParams {
  std::string scenario = "arena";
  std::string settings;
  int seed = 1;
  int threads = 1;
  double start_delay_s = 1.0;
  bool publish_tf_static = true;
  bool load_image_proc = false;
  bool driven = false;
  bool stepped = false;
  double step_s = 0.02;
  std::string frame_answers;
  std::string step_answers;
  double answer_limit_s = 5.0;

  void describe(ParameterVisitor& visitor);
};

}  // namespace stereo_nav::nodes
