#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stereo_nav/ros/recording.h"

namespace stereo_nav::tools {

/// What is run on the recording.
enum class EvaluatedMethod { kVisual, kWheel, kLaser, kMono };

struct EvaluateOptions {
  std::string bag;
  EvaluatedMethod method = EvaluatedMethod::kVisual;
  std::string
      rig;  ///< path of the rig file: wheels, for kWheel; uncertainty, for kVisual; may be empty there
  std::string config;                         ///< path of the odometry's parameter file
  std::string disparity_config;               ///< path of the disparity map's parameter file
  std::optional<std::string> disparity_from;  ///< bag whose camera/disparity is taken; absent: computed
  std::optional<std::string>
      ground_truth;  ///< TUM file or topic; absent: ground_truth/odom if the bag has it
  std::optional<std::string> ground_truth_frame;
  double truth_sigma_m = 0.0;    ///< noise of the ground truth, for the consistency of the covariances
  double truth_sigma_deg = 0.0;  ///< likewise of its attitudes
  std::string output;            ///< folder
  ros_io::RecordingOptions part;
  bool on_floor = false;                  ///< the base stays on the floor on which it starts
  std::vector<double> segment_lengths_m;  ///< of the pieces that errors are taken over besides the usual ones
  bool no_prior = false;  ///< by laser or camera alone, though the recording holds wheels or an IMU
  bool no_imu = false;    ///< by vision alone, though the recording holds an IMU
  int repeat = 1;
};

/// Nothing when help was asked for and printed. Throws InputError with one line for bad arguments.
std::optional<EvaluateOptions> parseEvaluateOptions(int argc, char** argv);

}  // namespace stereo_nav::tools
