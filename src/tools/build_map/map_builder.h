#pragma once

#include <vector>

#include "mapping/loop/loop_finder.h"
#include "mapping/map/robust_optimiser.h"
#include "mapping/map/visual_map.h"

namespace stereo_nav::tools {

/// Makes a map of keyframes in their order: finds loops, and closes them all together at the end.
class MapBuilder {
 public:
  /// Throws ParameterError.
  MapBuilder(const mapping::LoopParams& loops, const mapping::RobustParams& closing,
             const vision::StereoCalibration& calibration);

  /// Adds a keyframe that the odometry has at this pose. Returns what became of its candidates.
  std::vector<mapping::LoopCandidate> add(const vision::Keyframe& keyframe,
                                          const Eigen::Isometry3d& T_odom_camera);

  /// Moves the keyframes so that the loops close, without those that are false, and places the landmarks.
  void close();

  const mapping::VisualMap& map() const { return map_; }
  /// Of the last close(), one a loop of the map.
  const std::vector<mapping::LoopVerdict>& verdicts() const { return verdicts_; }

 private:
  void placeLandmarks();

  mapping::RobustParams closing_;
  vision::StereoCalibration calibration_;
  mapping::LoopFinder finder_;
  mapping::VisualMap map_;
  std::vector<mapping::LoopVerdict> verdicts_;
};

}  // namespace stereo_nav::tools
