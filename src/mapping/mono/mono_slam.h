#pragma once

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "mapping/mono/mono_motion.h"
#include "mapping/mono/mono_params.h"
#include "mapping/mono/mono_update.h"
#include "vision/grid_corner_detector.h"

namespace stereo_nav::mapping {

/// A point in the world whose place is known when it is first seen, such as a corner of a board.
struct KnownPoint {
  Eigen::Vector3d p_world;  ///< m
  Eigen::Vector2d px;       ///< where the first image shows it
};

/// One image and what else is known at its time.
struct MonoFrame {
  double time_s = 0.0;
  cv::Mat image;           ///< CV_8UC1, of the camera's size
  double readout_s = 0.0;  ///< of a rolling shutter; the time is that of the middle row
  std::optional<MeasuredTurn> turn;
  std::optional<MeasuredVelocity> velocity;
};

/// A landmark as the filter treated it in a frame, for pictures of it.
struct SearchedLandmark {
  enum class Outcome { kNotFound, kRejected, kLowInnovation, kHighInnovation };
  int id = 0;
  Eigen::Vector2d expected_px = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Zero();  ///< of the innovation
  Eigen::Vector2d found_px = Eigen::Vector2d::Zero();        ///< where it is found
  Outcome outcome = Outcome::kNotFound;
};

struct MonoResult {
  enum class State {
    kTracking,
    kCoasting,  ///< too few landmarks are found: the last velocity goes on
    kLost       ///< for too long: the pose is a guess, a new map of unknown scale begins here
  };
  double time_s = 0.0;
  State state = State::kTracking;
  std::string reason;  ///< why it is not kTracking
  CameraState camera;
  Matrix6d pose_covariance = Matrix6d::Zero();      ///< position, rotation; axes of the world
  Matrix6d velocity_covariance = Matrix6d::Zero();  ///< v in the axes of the world, omega in the camera's
  bool scale_known = false;
  std::size_t landmarks = 0;
  std::size_t inliers = 0;
  std::vector<SearchedLandmark> searched;
};

/// EKF-SLAM with one camera: Davison et al. 2007 (MonoSLAM), with landmarks in inverse depth (Civera, Davison
/// and Montiel 2008) and 1-point RANSAC (Civera et al. 2010). The world has the axes of the first camera; its
/// unit is m where known points or velocities give the scale, else about 1 / inverse_depth_start. Two runs
/// give the same bits.
class MonoSlam {
 public:
  /// Throws InputError for an image size of less than 64 px.
  MonoSlam(const MonoParams& params, const MonoCamera& camera);

  /// The next image. Stamps increase. Throws InputError for an image of another size or type.
  MonoResult process(const MonoFrame& frame);

  /// Starts anew from points of known places, at least 4 (knownStart()): the scale is that of the points.
  /// Throws InputError where these determine no pose.
  MonoResult start(const MonoFrame& frame, const std::vector<KnownPoint>& points);

  void reset();
  const MonoState& state() const { return state_; }
  const MonoCamera& camera() const { return camera_; }

  /// For measures of the drift: puts the present pose into the state, in the place of that with `old_id`.
  int renewPastPose(std::optional<int> old_id);
  /// The present pose relative to that one.
  RelativePose sincePastPose(int id) const;

 private:
  void begin(const MonoFrame& frame);
  void startNewMap(const cv::Mat& image);
  std::optional<PixelMatch> look(const cv::Mat& image, std::size_t block, SearchedLandmark& searched) const;
  std::vector<PixelMatch> search(const cv::Mat& image, MonoResult& result);
  std::vector<PixelMatch> searchAgain(const cv::Mat& image, MonoResult& result) const;
  std::size_t correct(const cv::Mat& image, MonoResult& result);
  void account(const std::vector<PixelMatch>& matches, SearchedLandmark::Outcome outcome, MonoResult& result);
  void forget();
  void addLandmarks(const cv::Mat& image, const CameraState& camera);
  void complete(const MonoFrame& frame, MonoResult& result);

  MonoParams params_;
  MonoCamera camera_;
  ImageModel model_;
  vision::GridCornerDetector detector_;
  MonoState state_;
  std::mt19937 random_;
  std::optional<double> last_s_;
  int frame_ = 0;
  int coasting_ = 0;
  bool scale_known_ = false;
};

}  // namespace stereo_nav::mapping
