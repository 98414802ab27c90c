#pragma once

#include <cstdint>
#include <vector>

#include "odometry/stereo/window_optimizer.h"

namespace stereo_nav::odometry {

/// The keyframes of the last seconds, the landmarks seen from them, and, while it is being processed, the
/// current frame. The world is the left camera of the first frame.
class LocalMap {
 public:
  /// Holds at most `keyframes` keyframes.
  LocalMap(int keyframes, const WindowOptimizerParams& params, const vision::StereoCalibration& calibration)
      : most_keyframes_(keyframes), optimizer_(params, calibration) {}

  /// Empties the map; ids of landmarks go on.
  void clear();
  /// Begins a new map with its first keyframe.
  void start(const WindowFrame& first);

  bool empty() const { return frames_.empty(); }
  /// Whether the first keyframe is the only frame.
  bool isAtStart() const { return frames_.size() == 1; }
  /// The current frame, or the last keyframe if there is no current frame.
  const WindowFrame& newest() const { return frames_.back(); }
  /// The frame before the newest one: the last keyframe while there is a current frame.
  WindowFrame& beforeNewest() { return frames_[frames_.size() - 2]; }
  const WindowFrame& oldest() const { return frames_.front(); }

  /// All landmarks, in order of their ids. The reference is valid until a landmark is added or removed.
  std::vector<Landmark>& landmarks() { return landmarks_; }
  const std::vector<Landmark>& landmarks() const { return landmarks_; }
  /// Null if the map has no landmark of this id.
  const Landmark* find(std::uint64_t id) const;

  /// Adds the current frame, which is the newest from here on.
  void addFrame(const WindowFrame& frame) { frames_.push_back(frame); }
  /// Adds what the newest frame saw of a landmark of the map.
  void addObservation(std::uint64_t id, const vision::StereoObservation& seen);
  /// Adds a landmark that the newest frame sees for the first time. Returns its id, which is set here.
  std::uint64_t addLandmark(Landmark landmark, const vision::StereoObservation& seen);
  /// Refines all poses but the oldest one and all landmarks together.
  void refine() { optimizer_.optimise(frames_, landmarks_); }
  /// What one keyframe adds to the uncertainty of the poses, for pixels of unit variance: the newest frame's
  /// covariance relative to the oldest one, shared among those between. Nothing where it is unknown.
  std::optional<Matrix6d> growth() const;
  /// The newest frame's covariance relative to the last keyframe, for pixels of unit variance, with the
  /// landmarks as uncertain as they are. Nothing where it is unknown.
  std::optional<Matrix6d> noise() const;

  /// The current frame is no keyframe: it and its observations are removed.
  void removeNewest();
  /// The current frame becomes a keyframe; the oldest ones leave, with their observations.
  void keepNewest();
  /// Removes the landmarks that neither are followed nor tie two keyframes together. `followed` holds ids in
  /// increasing order.
  void removeUnused(const std::vector<std::uint64_t>& followed);

 private:
  int most_keyframes_;
  WindowOptimizer optimizer_;
  std::vector<WindowFrame> frames_;  ///< oldest first
  std::vector<Landmark> landmarks_;
  std::uint64_t next_id_ = 1;
};

}  // namespace stereo_nav::odometry
