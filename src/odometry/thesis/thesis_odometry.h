#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/rotation_history.h"
#include "odometry/thesis/motion.h"
#include "odometry/thesis/rigidity.h"
#include "stereo_nav/odometry/common/odometry.h"
#include "vision/corner_detector.h"
#include "vision/disparity_lifter.h"
#include "vision/klt_tracker.h"

namespace stereo_nav::odometry {

struct ThesisParams {
  /// Where the rotation between two frames comes from.
  enum class Rotation {
    kImu,     ///< the IMU alone, as in the thesis; a frame that it does not cover is lost
    kVision,  ///< the features alone: closed form on the clique, refined on the reprojection error
    kAuto,    ///< the IMU where it covers the frame, the features elsewhere
  };
  vision::CornerDetectorParams corners;
  vision::KltParams tracking;
  vision::DisparityLifterParams depth;
  RigidityParams rigidity;
  RefinementParams refinement;
  Rotation rotation = Rotation::kAuto;
  DisparityUse disparity = DisparityUse::kMatched;
  int min_inliers = 6;

  void describe(ParameterVisitor& visitor);
};

/// The visual odometry of the thesis: FAST corners per bucket, KLT, depth from the disparity map, rigidity
/// graph, greedy maximum clique, rotation from the IMU, translation as the mean of R a - b. Where there is no
/// IMU the motion of the clique comes from vision alone.
class ThesisOdometry : public Odometry {
 public:
  ThesisOdometry(const ThesisParams& params, const vision::StereoCalibration& calibration,
                 const Eigen::Matrix3d& R_camera_imu);

  void addImu(const ImuSample& sample) override { imu_.add(sample); }
  FrameResult process(const StereoFrame& frame) override;
  void reset() override;

 private:
  /// What the next frame is measured against: the last image with enough corners of known depth.
  struct Reference {
    double time_s;
    cv::Mat image;
    std::vector<cv::Point2f> corners;       ///< px, all of known depth
    std::vector<Eigen::Vector3d> p_camera;  ///< of the corners, left optical frame, m
  };
  /// Corners of the reference that were found and lifted in the current frame; all vectors run in parallel.
  struct Tracked {
    std::vector<std::size_t> report;  ///< index into FrameResult::features
    std::vector<PointPair> pairs;
  };

  void measureMotion(const StereoFrame& frame, FrameResult& result);
  Tracked trackAndLift(const StereoFrame& frame, FrameResult& result) const;
  std::vector<std::size_t> selectRigid(const Tracked& tracked, FrameResult& result) const;
  void estimate(const Tracked& tracked, const std::vector<std::size_t>& clique, double time_s,
                FrameResult& result);
  void estimateWithImu(const std::vector<PointPair>& pairs, const Eigen::Matrix3d& R_current_previous,
                       FrameResult& result);
  bool estimateFromVision(const std::vector<PointPair>& pairs, std::vector<bool>& inlier,
                          FrameResult& result);
  void adoptReference(const StereoFrame& frame, FrameResult& result);

  ThesisParams params_;
  vision::StereoCalibration calibration_;
  Eigen::Matrix3d R_camera_imu_;
  vision::CornerDetector corner_detector_;
  vision::KltTracker tracker_;
  vision::DisparityLifter lifter_;
  RotationHistory imu_;

  std::optional<Reference> reference_;
  Eigen::Isometry3d T_start_camera_ = Eigen::Isometry3d::Identity();  ///< pose of the last tracked frame
  Eigen::Matrix3d R_tracked_reference_ =
      Eigen::Matrix3d::Identity();  ///< turn since then, over lost frames, by IMU
};

}  // namespace stereo_nav::odometry
