#include "nodes/simulator/simulator_params.h"

namespace stereo_nav::nodes {

void SimulatorParams::describe(ParameterVisitor& visitor) {
  visitor.text("scenario", scenario, "a file, or the name of one in config/scenarios");
  visitor.text("settings", settings, "changes to the scenario: NAME=VALUE, separated by semicolons");
  visitor.integer("seed", seed, {0, 1000000000}, "", "seed of noise, jitter and IMU errors");
  visitor.integer("threads", threads, {1, 64}, "", "threads that render");
  visitor.real("start_delay_s", start_delay_s, {0.0, 3600.0}, "s",
               "from the start of the node to the first pair");
  visitor.flag("publish_tf_static", publish_tf_static,
               "publish where the sensors sit; off where rig_transforms does");
  visitor.flag("load_image_proc", load_image_proc, "rectify and compute disparity in this process");
  visitor.flag("driven", driven, "the robot follows cmd_vel instead of the path of the scenario");
  visitor.flag("stepped", stepped,
               "driven: the simulator is the clock of ROS, and waits for answers; needs /use_sim_time");
  visitor.real("step_s", step_s, {0.001, 1.0}, "s", "stepped: time between two messages of the clock");
  visitor.text("frame_answers", frame_answers,
               "stepped: topics, separated by spaces, with one message for each stereo pair, e.g. vo/status");
  visitor.text("step_answers", step_answers,
               "stepped: topics with one message or more in each step, e.g. cmd_vel");
  visitor.real("answer_limit_s", answer_limit_s, {0.01, 600.0}, "s",
               "stepped: real time after which it goes on without an answer, and says so");
}

}  // namespace stereo_nav::nodes
