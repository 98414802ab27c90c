#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "stereo_nav/core/imu_sample.h"
#include "stereo_nav/core/lie.h"
#include "stereo_nav/vision/stereo_calibration.h"

namespace stereo_nav::odometry {

constexpr double kLongestReadout_s = 0.2;  ///< no rolling shutter takes longer

/// A rectified stereo pair. Left and right carry their own times: two free-running cameras never agree.
/// Images that hold their memory may be kept until the next frame: they are not to be written to.
struct StereoFrame {
  double left_time_s = 0.0;   ///< when the left image was taken
  double right_time_s = 0.0;  ///< when the right image was taken
  /// Rolling shutter: time from the first row to the last; the times above are the middle row's.
  double readout_s = 0.0;
  cv::Mat left;       ///< CV_8UC1, rectified
  cv::Mat right;      ///< CV_8UC1, rectified; may be empty where the composition only uses the disparity map
  cv::Mat disparity;  ///< CV_32FC1 in px, values <= 0 or NaN mean "no disparity"; empty if there is no map
};

/// Which disparity map an odometry wants in StereoFrame::disparity.
enum class DisparityUse {
  kNone,     ///< reads none: nobody needs to compute it
  kMatched,  ///< that of the frame itself
  kLatest,   ///< the newest that has come, often that of the frame before, as the thesis' program did
};

/// How the pose of a frame was found; the values are those of VoStatus.msg.
enum class State {
  kInitialising,  ///< a map has just begun: the motion, if any, is measured but not confirmed yet
  kTracking,      ///< the motion was measured
  kCoasting,      ///< nothing is measured; the pose goes on with the last velocity
  kLost           ///< nothing is known of the motion but what the IMU says
};

/// Whether the pose of the frame was measured, be it confirmed or not yet.
inline bool isMeasured(State state) {
  return state == State::kTracking || state == State::kInitialising;
}

/// What became of one feature of the left image, for pictures and clouds.
struct FeatureReport {
  /// How far a feature came: kInlier passed every test.
  enum class Fate { kDetected, kNoDepth, kRejected, kInlier };
  std::uint64_t id = 0;  ///< the same while the feature is followed
  cv::Point2f
      previous_px;  ///< where it was in the frame the motion is measured against; equals current_px if new
  cv::Point2f current_px;                              ///< where it is in the left image
  Fate fate = Fate::kDetected;                         ///< how far it came
  Eigen::Vector3d p_camera = Eigen::Vector3d::Zero();  ///< left optical frame, m; zero if without depth
  // Of keyframes alone, by odometries that keep a map:
  cv::Point2f stamp_px;             ///< current_px as a global shutter would have seen it at the stamp
  double disparity_px = 0.0;        ///< of p_camera, as the map has it; 0: unknown
  double disparity_sigma_px = 0.0;  ///< its standard deviation
};

/// Wall-clock time that a stage of this frame took.
struct StageTime {
  const char* stage;    ///< name of the stage, a literal
  double milliseconds;  ///< wall-clock time
};

/// What errors of the calibration do to a motion, all frames alike: how much further or more turned it comes
/// out, in the current camera frame (m, rad), for each unit of: the right camera's columns, offset by 1 px;
/// the radial and the two tangential errors of the left lens, then of the right one, whose RMS over the image
/// is 1 px together.
using CalibrationEffects = Eigen::Matrix<double, 6, 7>;

/// Everything that one frame yields. Poses are of the left optical frame, relative to its pose in the first
/// frame.
struct FrameResult {
  State state = State::kInitialising;  ///< what the frame means for the pose
  std::string reason;  ///< why it is not kTracking: what was seen, the likely cause, the remedy
  Eigen::Isometry3d T_start_camera = Eigen::Isometry3d::Identity();  ///< position held while lost
  /// Motion since the previous frame; where it was measured after frames without a measurement, since the
  /// last measured pose of the same map.
  Eigen::Isometry3d T_previous_current = Eigen::Isometry3d::Identity();
  /// While kCoasting or kLost: covariance of the predicted motion since the last kTracking pose or the last
  /// `new_map`; zero where only the time without a measurement tells how far it went. Otherwise: what the
  /// motion adds to the uncertainty of this pose and all later ones, current camera frame: m, m, m, rad, rad,
  /// rad. Where frames are measured against a map it is that of the map's growth.
  Matrix6d motion_covariance = Matrix6d::Zero();
  /// Noise of this frame's pose alone, which later frames do not share; current camera frame, as above.
  Matrix6d pose_noise = Matrix6d::Zero();
  /// Of T_previous_current; zero where unknown.
  CalibrationEffects calibration_effects = CalibrationEffects::Zero();
  /// A map began with this frame, at a pose that was not measured; that of the first frame is by definition.
  bool new_map = false;
  bool turn_is_measured = false;          ///< while kCoasting or kLost: the rotation is the IMU's
  bool keyframe = false;                  ///< whether this frame became a keyframe
  std::uint32_t keyframe_id = 0;          ///< of the newest keyframe
  std::uint32_t features_detected = 0;    ///< all features of the left image
  std::uint32_t features_tracked = 0;     ///< those found again
  std::uint32_t features_with_depth = 0;  ///< those of the tracked ones with a depth
  std::uint32_t clique_size = 0;          ///< features that moved rigidly together
  std::uint32_t inliers = 0;              ///< features that the motion was computed from
  double reprojection_error_px = std::numeric_limits<double>::quiet_NaN();      ///< RMS over the inliers
  double rotation_disagreement_rad = std::numeric_limits<double>::quiet_NaN();  ///< between images and IMU
  /// Constant error of the right images' stamps, stamp minus true time; NaN where unknown.
  double right_stamp_error_s = std::numeric_limits<double>::quiet_NaN();
  double right_stamp_sigma_s = std::numeric_limits<double>::quiet_NaN();  ///< of that error
  bool right_stamps_are_corrected = false;  ///< the error is beyond doubt, and later stamps are freed from it
  bool time_offset_compensated = false;     ///< whether the images' different times were taken into account
  std::vector<FeatureReport> features;      ///< one for each feature
  std::vector<StageTime> stage_times;       ///< in the order in which the stages ran
};

/// What the nodes and tools know of a visual odometry. Not thread-safe: one caller feeds it, frames in order
/// of time. Deterministic: equal input gives equal output to the last bit.
class Odometry {
 public:
  virtual ~Odometry() = default;

  /// Samples in order of time (older ones are ignored); those around a frame's stamps must come before the
  /// frame.
  virtual void addImu(const ImuSample& sample) = 0;

  /// Frames must be of the calibration's size and in order of time; throws std::invalid_argument where it can
  /// tell that they are not.
  virtual FrameResult process(const StereoFrame& frame) = 0;

  /// Forgets frames, features and IMU samples; the next frame is a new start.
  virtual void reset() = 0;
};

}  // namespace stereo_nav::odometry
