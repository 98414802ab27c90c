#include "odometry/thesis/thesis_odometry.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "core/angles.h"
#include "odometry/common/greedy_clique.h"
#include "odometry/common/stage_clock.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::odometry {
namespace {

/// First model of the IMU's share of the uncertainty: half a degree a frame, of a serial angle module.
constexpr double kImuRotationSigma_rad = 0.5 * kRadPerDeg;

void checkImages(const StereoFrame& frame, const vision::StereoCalibration& calibration) {
  const cv::Size expected(calibration.width, calibration.height);
  const bool left_fits = frame.left.type() == CV_8UC1 && frame.left.size() == expected;
  const bool map_fits =
      frame.disparity.empty() || (frame.disparity.type() == CV_32FC1 && frame.disparity.size() == expected);
  if (left_fits && map_fits) return;
  std::ostringstream message;
  message << "image is " << frame.left.cols << "x" << frame.left.rows << ", disparity "
          << frame.disparity.cols << "x" << frame.disparity.rows << ", calibration is for " << expected.width
          << "x" << expected.height << " (image must be 8 bit grey, disparity 32 bit float)";
  throw std::invalid_argument(message.str());
}

std::string tooFew(const char* what, std::size_t seen, int needed, const char* cause) {
  std::ostringstream message;
  message << "only " << seen << " " << what << ", " << needed << " needed: " << cause;
  return message.str();
}

double rmsReprojection(const vision::StereoCalibration& calibration, const std::vector<PointPair>& pairs,
                       const Eigen::Isometry3d& T_current_previous) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const PointPair& pair : pairs) {
    if (!isProjectable(pair, T_current_previous)) continue;
    squares += reprojectionResidual(calibration, pair, T_current_previous, nullptr).squaredNorm();
    ++count;
  }
  return std::sqrt(squares / static_cast<double>(3 * count));
}

}  // namespace

void ThesisParams::describe(ParameterVisitor& visitor) {
  visitSection(visitor, "corners", corners);
  visitSection(visitor, "tracking", tracking);
  visitSection(visitor, "depth", depth);
  visitSection(visitor, "rigidity", rigidity);
  visitSection(visitor, "refinement", refinement);
  visitEnum(visitor, "rotation", rotation,
            {{"imu", Rotation::kImu}, {"vision", Rotation::kVision}, {"auto", Rotation::kAuto}},
            "source of the rotation between two frames; auto: the IMU where it covers them, else vision");
  visitEnum(
      visitor, "disparity", disparity,
      {{"matched", DisparityUse::kMatched}, {"latest", DisparityUse::kLatest}},
      "disparity map used with an image: its own, or the newest that has arrived (the thesis' program)");
  visitor.integer("min_inliers", min_inliers, {3, 1000}, "",
                  "fewer rigid features are no motion: the frame is lost");
}

ThesisOdometry::ThesisOdometry(const ThesisParams& params, const vision::StereoCalibration& calibration,
                               const Eigen::Matrix3d& R_camera_imu)
    : params_(params),
      calibration_(calibration),
      R_camera_imu_(R_camera_imu),
      corner_detector_(params.corners),
      tracker_(params.tracking),
      lifter_(params.depth, calibration) {
  validateParameters(params, "thesis");
}

void ThesisOdometry::reset() {
  reference_.reset();
  imu_.clear();
  T_start_camera_.setIdentity();
  R_tracked_reference_.setIdentity();
}

FrameResult ThesisOdometry::process(const StereoFrame& frame) {
  checkImages(frame, calibration_);
  FrameResult result;
  if (reference_) {
    measureMotion(frame, result);
  } else {
    result.reason = "no frame before: this one has nothing to measure its motion against";
  }
  if (result.state == State::kTracking) {
    T_start_camera_ = T_start_camera_ * result.T_previous_current;
    R_tracked_reference_.setIdentity();
  }
  result.T_start_camera = T_start_camera_;
  adoptReference(frame, result);
  return result;
}

void ThesisOdometry::measureMotion(const StereoFrame& frame, FrameResult& result) {
  result.state = State::kLost;
  if (frame.disparity.empty()) {
    result.reason = "no disparity map: is the disparity nodelet running, and are both cameras?";
    return;
  }
  const Tracked tracked = trackAndLift(frame, result);
  if (tracked.pairs.size() < static_cast<std::size_t>(params_.min_inliers)) {
    result.reason = tooFew("tracked features with depth", tracked.pairs.size(), params_.min_inliers,
                           "dark, blocked, without texture, or nearer than the disparity range reaches");
    return;
  }
  const std::vector<std::size_t> clique = selectRigid(tracked, result);
  if (clique.size() < static_cast<std::size_t>(params_.min_inliers)) {
    result.reason = tooFew("features move as one rigid body", clique.size(), params_.min_inliers,
                           "moving objects fill the view, or depth is too noisy");
    return;
  }
  estimate(tracked, clique, frame.left_time_s, result);
}

ThesisOdometry::Tracked ThesisOdometry::trackAndLift(const StereoFrame& frame, FrameResult& result) const {
  StageClock clock(result.stage_times);
  const auto tracks = tracker_.track(reference_->image, frame.left, reference_->corners);
  clock.lap("track");
  Tracked tracked;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    FeatureReport report;
    report.id = i;
    report.previous_px = reference_->corners[i];
    report.current_px = tracks[i].position;
    if (!tracks[i].found) continue;
    ++result.features_tracked;
    report.fate = FeatureReport::Fate::kNoDepth;
    if (const auto lifted = lifter_.lift(frame.disparity, tracks[i].position)) {
      report.fate = FeatureReport::Fate::kRejected;
      report.p_camera = lifted->p_camera;
      tracked.report.push_back(result.features.size());
      tracked.pairs.push_back({reference_->p_camera[i], lifted->p_camera});
    }
    result.features.push_back(report);
  }
  result.features_with_depth = static_cast<std::uint32_t>(tracked.pairs.size());
  clock.lap("triangulate");
  return tracked;
}

std::vector<std::size_t> ThesisOdometry::selectRigid(const Tracked& tracked, FrameResult& result) const {
  StageClock clock(result.stage_times);
  std::vector<Eigen::Vector3d> before;
  std::vector<Eigen::Vector3d> now;
  for (const PointPair& pair : tracked.pairs) {
    before.push_back(pair.p_previous);
    now.push_back(pair.p_current);
  }
  std::vector<std::size_t> clique = greedyClique(buildRigidityGraph(params_.rigidity, before, now));
  result.clique_size = static_cast<std::uint32_t>(clique.size());
  clock.lap("select");
  return clique;
}

void ThesisOdometry::estimate(const Tracked& tracked, const std::vector<std::size_t>& clique, double time_s,
                              FrameResult& result) {
  StageClock clock(result.stage_times);
  std::vector<PointPair> pairs;
  for (const std::size_t member : clique) pairs.push_back(tracked.pairs[member]);
  std::vector<bool> inlier(pairs.size(), true);

  const auto R_current_previous = params_.rotation == ThesisParams::Rotation::kVision
                                      ? std::nullopt
                                      : imu_.increment(reference_->time_s, time_s, R_camera_imu_);
  if (R_current_previous) {
    estimateWithImu(pairs, *R_current_previous, result);
  } else if (params_.rotation == ThesisParams::Rotation::kImu) {
    result.reason =
        "no IMU rotation between the images: is the IMU running, and are its stamps of the same clock?";
    return;
  } else if (!estimateFromVision(pairs, inlier, result)) {
    return;
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!inlier[i]) continue;
    ++result.inliers;
    result.features[tracked.report[clique[i]]].fate = FeatureReport::Fate::kInlier;
  }
  result.state = State::kTracking;
  // Lost frames in between have moved the reference on; what the IMU saw of their turn is kept.
  Eigen::Isometry3d T_tracked_reference = Eigen::Isometry3d::Identity();
  T_tracked_reference.linear() = R_tracked_reference_;
  result.T_previous_current = T_tracked_reference * result.T_previous_current;
  clock.lap("estimate");
}

void ThesisOdometry::estimateWithImu(const std::vector<PointPair>& pairs,
                                     const Eigen::Matrix3d& R_current_previous, FrameResult& result) {
  const Eigen::Vector3d t = meanTranslation(R_current_previous, pairs);
  Eigen::Isometry3d T_current_previous = Eigen::Isometry3d::Identity();
  T_current_previous.linear() = R_current_previous;
  T_current_previous.translation() = -t;
  result.T_previous_current = T_current_previous.inverse();
  result.reprojection_error_px = rmsReprojection(calibration_, pairs, T_current_previous);

  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const PointPair& pair : pairs) {
    const Eigen::Vector3d deviation = R_current_previous * pair.p_previous - pair.p_current - t;
    scatter += deviation * deviation.transpose();
  }
  const auto n = static_cast<double>(pairs.size());
  result.motion_covariance.topLeftCorner<3, 3>() = scatter / (n * (n - 1.0));
  result.motion_covariance.bottomRightCorner<3, 3>() =
      Eigen::Matrix3d::Identity() * (kImuRotationSigma_rad * kImuRotationSigma_rad);
}

bool ThesisOdometry::estimateFromVision(const std::vector<PointPair>& pairs, std::vector<bool>& inlier,
                                        FrameResult& result) {
  const RefinedMotion motion = refineMotion(params_.refinement, calibration_, pairs, alignPoints(pairs));
  if (!motion.converged || motion.inliers < static_cast<std::size_t>(params_.min_inliers)) {
    result.reason = tooFew("features agree with one motion", motion.inliers, params_.min_inliers,
                           "moving objects fill the view, or the features lie on one line");
    return false;
  }
  inlier = motion.inlier;
  result.T_previous_current = motion.T_current_previous.inverse();
  result.motion_covariance = motion.covariance;
  result.reprojection_error_px = motion.rms_px;
  return true;
}

void ThesisOdometry::adoptReference(const StereoFrame& frame, FrameResult& result) {
  StageClock clock(result.stage_times);
  const std::vector<cv::Point2f> corners = corner_detector_.detect(frame.left);
  result.features_detected = static_cast<std::uint32_t>(corners.size());
  Reference next{frame.left_time_s, frame.left.clone(), {}, {}};
  for (const cv::Point2f& corner : corners) {
    const auto lifted = frame.disparity.empty() ? std::nullopt : lifter_.lift(frame.disparity, corner);
    if (!lifted) continue;
    next.corners.push_back(corner);
    next.p_camera.push_back(lifted->p_camera);
  }
  clock.lap("detect");
  // A dark or blocked frame is no reference: the one before it stays, so that a short gap is bridged.
  if (next.corners.size() < static_cast<std::size_t>(params_.min_inliers)) return;
  if (reference_ && result.state == State::kLost) {
    if (const auto R_current_previous =
            imu_.increment(reference_->time_s, frame.left_time_s, R_camera_imu_)) {
      R_tracked_reference_ = R_tracked_reference_ * R_current_previous->transpose();
    }
  }
  result.new_map = reference_ && result.state == State::kLost;
  reference_ = std::move(next);
  result.keyframe = true;
}

}  // namespace stereo_nav::odometry
