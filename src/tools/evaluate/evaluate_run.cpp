#include "tools/evaluate/evaluate_run.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "core/angles.h"
#include "core/base_pose.h"
#include "core/rig_file.h"
#include "odometry/method/watched_odometry.h"
#include "ros/package_files.h"
#include "ros/setup_checks.h"
#include "ros/stereo_processing.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/topics.h"
#include "tools/common/recorded_rig.h"
#include "tools/evaluate/recorded_disparity.h"
#include "tools/evaluate/relative_covariance.h"
#include "vision/camera_order.h"

namespace stereo_nav::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kFramesBetweenOrderChecks = 10;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

PoseParams poseParams(const EvaluateOptions& options) {
  PoseParams params;
  params.floor.on = options.on_floor;
  if (options.rig.empty()) return params;
  const RigFile rig = RigFile::load(options.rig);
  readParameters(rig.section(rig_sections::kUncertainty), rig.sectionName(rig_sections::kUncertainty),
                 params.uncertainty);
  return params;
}

/// One pass over the recording.
class Run {
 public:
  Run(const ros_io::Recording& recording, const ros_io::StereoProcessing& processing,
      const odometry::OdometryConfig& config, const std::optional<std::string>& disparity_bag,
      const Eigen::Isometry3d& T_base_camera, const PoseParams& pose_params, const ImuMounting& imu,
      double right_stamp_error_s)
      : recording_(recording),
        processing_(processing),
        config_(config),
        T_base_camera_(T_base_camera),
        uncertainty_(pose_params, T_base_camera),
        imu_problem_(imu.problem),
        odometry_(config_, processing.calibration(), {T_base_camera.linear(), imu.R_base_imu}),
        right_stamp_error_s_(right_stamp_error_s),
        camera_order_(processing.calibration()),
        imu_(recording) {
    if (disparity_bag && config_.disparityUse() != odometry::DisparityUse::kNone)
      recorded_disparity_.emplace(*disparity_bag);
  }

  eval::FrameRecord handle(const ros_io::RawPair& pair) {
    odometry::StereoFrame frame = rectifiedFrame(processing_, pair);
    frame.right_time_s -= right_stamp_error_s_;
    eval::FrameRecord record;
    if (config_.disparityUse() != odometry::DisparityUse::kNone) {
      const auto start = Clock::now();
      frame.disparity = disparityFor(frame);
      record.timing.disparity_ms = millisecondsSince(start);
    }
    if (imu_problem_.empty()) imu_.feed(std::max(pair.left_time_s, pair.right_time_s), odometry_);
    if (frames_++ % kFramesBetweenOrderChecks == 0) camera_order_.observe(frame.left, frame.right);
    const auto start = Clock::now();
    const odometry::FrameResult result = odometry_.process(frame);
    if (result.right_stamps_are_corrected) found_right_stamp_error_s_ = result.right_stamp_error_s;
    record.timing.frame_ms = millisecondsSince(start);
    for (const odometry::StageTime& stage : result.stage_times) {
      record.timing.stages_ms.emplace_back(stage.stage, stage.milliseconds);
    }
    record.time_s = pair.left_time_s;
    record.clock_offset_s = recording_.clockOffset_s(pair.left_time_s);
    const estimation::UncertainPose pose = uncertainty_.add(result, record.time_s);
    record.pose_covariance = pose.covariance;
    if (odometry::isMeasured(result.state))
      record.T_odom_base = pose.T_odom_base;
    else
      record.reason = result.reason;
    // The thesis detects a new set in every frame, the default only where tracks are missing.
    record.features = std::max(result.features_detected, result.features_tracked);
    record.inliers = result.inliers;
    return record;
  }

  bool camerasAreSwapped() const {
    return camera_order_.verdict() == vision::CameraOrderCheck::Verdict::kSwapped;
  }
  /// Why the IMU contradicts the images; empty while it is used, or was not used from the start.
  const std::string& imuContradiction() const { return odometry_.imuProblem(); }
  /// By how much the right stamps are still off, stamp minus true time; 0 where nothing speaks for it.
  double rightStampError_s() const { return found_right_stamp_error_s_; }
  /// What the frames told of their uncertainty.
  RelativeCovariance takeUncertainty() { return std::move(uncertainty_); }

 private:
  /// `latest` is what the thesis' program gets: the map of the frame before, since this one's is still being
  /// computed.
  cv::Mat disparityFor(const odometry::StereoFrame& frame) {
    cv::Mat matched = recorded_disparity_ ? recorded_disparity_->at(frame.left_time_s)
                                          : processing_.disparity(frame.left, frame.right);
    if (config_.disparityUse() == odometry::DisparityUse::kMatched) return matched;
    std::swap(matched, previous_disparity_);
    return matched;
  }

  const ros_io::Recording& recording_;
  const ros_io::StereoProcessing& processing_;
  odometry::OdometryConfig config_;
  Eigen::Isometry3d T_base_camera_;
  RelativeCovariance uncertainty_;
  std::string imu_problem_;  ///< why it is not used
  odometry::WatchedOdometry odometry_;
  double right_stamp_error_s_;              ///< that is taken off
  double found_right_stamp_error_s_ = 0.0;  ///< beyond that
  std::size_t frames_ = 0;
  vision::CameraOrderCheck camera_order_;
  ImuFeed imu_;
  std::optional<RecordedDisparity> recorded_disparity_;
  cv::Mat previous_disparity_;
};

bool samePoses(const std::vector<eval::FrameRecord>& a, const std::vector<eval::FrameRecord>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one.T_odom_base.has_value() == other.T_odom_base.has_value() &&
           (!one.T_odom_base || one.T_odom_base->matrix() == other.T_odom_base->matrix());
  });
}

/// All of a run but its frames.
EvaluationRun begun(const EvaluateOptions& options, const ros_io::Recording& recording,
                    const ros_io::StereoProcessing& processing, const Eigen::Isometry3d& T_base_camera) {
  EvaluationRun run;
  run.unpaired_images = recording.unpairedImages();
  run.input.input = std::filesystem::path(options.bag).filename().string();
  run.input.config = std::filesystem::path(options.config).filename().string();
  run.input.T_base_camera = T_base_camera;
  run.input.camera_frame = recording.leftInfo().header.frame_id;
  run.input.notes = recording.notes();
  run.input.stretches = recording.stretches();
  run.input.notes.insert(run.input.notes.end(), processing.notes().begin(), processing.notes().end());
  run.input.ground_truth =
      groundTruthOfBase(recording, options.bag, options.ground_truth, options.ground_truth_frame);
  run.input.segment_lengths_m = options.segment_lengths_m;
  run.input.truth_sigma_m = options.truth_sigma_m;
  run.input.truth_sigma_rad = options.truth_sigma_deg / kDegPerRad;
  return run;
}

}  // namespace

EvaluationRun runEvaluation(const EvaluateOptions& options,
                            const std::function<void(std::size_t, std::size_t)>& progress) {
  const odometry::OdometryConfig config = odometry::loadOdometryConfig(options.config);
  const PoseParams pose_params = poseParams(options);
  ros_io::DisparityParams disparity;
  readParameters(loadYamlFile(options.disparity_config), options.disparity_config, disparity);

  const ros_io::Recording recording(options.bag, options.part);
  const ros_io::StereoProcessing processing(recording.leftInfo(), recording.rightInfo(), disparity);
  const Eigen::Isometry3d T_base_camera =
      requireTransform(recording, options.bag, ros_io::frames::kBase, recording.leftInfo().header.frame_id);
  ImuMounting imu = imuMounting(recording, options.no_imu);

  EvaluationRun run = begun(options, recording, processing, T_base_camera);
  double right_stamp_error_s = 0.0;
  for (int repetition = 0; repetition < options.repeat;) {
    Run pass(recording, processing, config, options.disparity_from, T_base_camera, pose_params, imu,
             right_stamp_error_s);
    std::vector<eval::FrameRecord> frames;
    frames.reserve(recording.pairs());
    recording.forEachPair([&](const ros_io::RawPair& pair) {
      frames.push_back(pass.handle(pair));
      run.timings.push_back(frames.back().timing);
      progress(run.timings.size(), recording.pairs() * static_cast<std::size_t>(options.repeat));
    });
    if (right_stamp_error_s == 0.0 && pass.rightStampError_s() != 0.0) {
      // Once more with right stamps from the first frame on.
      right_stamp_error_s = pass.rightStampError_s();
      run.timings.clear();
      continue;
    }
    if (!pass.imuContradiction().empty()) {
      // Once more by vision alone, from the first frame on.
      imu.problem = "the IMU contradicts the images: " + pass.imuContradiction();
      run.timings.clear();
      continue;
    }
    if (repetition++ == 0) {
      run.input.frames = std::move(frames);
      run.input.relative_covariance = pass.takeUncertainty();
      if (pass.camerasAreSwapped()) run.input.notes.push_back(ros_io::swappedCameras());
    } else if (!samePoses(run.input.frames, frames)) {
      throw std::logic_error("two runs on the same recording differ; this is a defect of the odometry");
    }
  }
  if (right_stamp_error_s != 0.0) run.input.notes.push_back(ros_io::wrongRightStamps(right_stamp_error_s));
  if (!imu.problem.empty()) {
    run.input.imu_set_aside = imu.problem;
    run.input.notes.push_back("the IMU is set aside, the path is that of vision alone: " + imu.problem);
  }
  return run;
}

}  // namespace stereo_nav::tools
