#pragma once

#include <functional>
#include <string>

#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {

enum class BaseFrame { kImu, kCamera };

struct BagOptions {
  int every = 1;                      ///< keep every N-th left image
  int right_lag_frames = 0;           ///< take the right image this many original frames after the left one
  double right_stamp_offset_s = 0.0;  ///< constant error that is added to the right stamps
  bool imu = true;
  BaseFrame base_frame = BaseFrame::kCamera;
};

struct BagSummary {
  std::size_t pairs = 0;
  std::size_t left_without_partner = 0;  ///< left images that were due but have no right one
};

/// Writes the sequence as a recording of a stereo rig, under the topics of ros_io/topics.h:
/// - images and camera_infos of both cameras, all in `camera_left_optical`, each with its own true stamp
/// (plus
///   the offset asked for, on the right); `camera/sync` says which belong together (its header: the left
///   stamp);
/// - `imu/data`, without orientation (orientation_covariance[0] = -1), in `imu_link`;
/// - `ground_truth/odom`: pose of base_link in `world` (twist not given, zero); where the layout's world is
/// the first
///   left camera, `world` is base_link's first pose;
/// - `tf_static` (latched): base_link to camera_left_optical (as rectified) and to imu_link.
/// base_link is the IMU, or the left camera with x forward, y left, z up (REP-103).
/// Messages are recorded at the time of their stamps, in order of time; equal input gives equal bytes.
/// Nothing is left behind unless the bag is complete. Throws InputError.
BagSummary writeBag(Sequence& sequence, const BagOptions& options, const std::string& path,
                    const std::function<void(std::size_t done, std::size_t all)>& progress);

}  // namespace stereo_nav::tools
