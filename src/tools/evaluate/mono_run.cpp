#include "tools/evaluate/mono_run.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "core/angles.h"
#include "core/processor_time.h"
#include "eval/alignment.h"
#include "mapping/mono/measured_motion.h"
#include "mapping/mono/mono_base.h"
#include "mapping/mono/mono_slam.h"
#include "ros/mono_recording.h"
#include "stereo_nav/core/parameters.h"
#include "tools/evaluate/truth_of_base.h"

namespace stereo_nav::tools {
namespace {

using mapping::MonoResult;

/// Covariances between the ends of the pieces that the NEES is taken over; axes of the camera at the later
/// end.
using PieceCovariances = std::map<std::pair<std::size_t, std::size_t>, Matrix6d>;

struct MonoPass {
  std::vector<MonoResult> results;
  std::vector<eval::FrameTiming> timings;
  PieceCovariances pieces;
};

mapping::MonoCamera cameraOf(const ros_io::RectifiedView& view) {
  return {view.fx(), view.fy(), view.cx(), view.cy(), 0.0, view.size()};
}

/// Feeds the filter with the frames of a recording, and with what else it holds.
class MonoFeed {
 public:
  MonoFeed(const mapping::MonoParams& params, const ros_io::MonoRecording& recording, bool imu, bool wheels)
      : params_(params), recording_(recording), slam_(params, cameraOf(recording.view())), wheels_(wheels) {
    R_camera_imu_ = recording.T_base_camera().linear().transpose() * recording.imu().R_base_imu;
    if (!imu) return;
    for (const ImuSample& sample : recording.imu().samples) imu_.add(sample);
  }

  MonoPass run(const std::function<void(std::size_t, std::size_t)>& progress) {
    recording_.forEachImage([&](const ros_io::MonoImage& image) {
      add(image);
      progress(pass_.results.size(), recording_.times_s().size());
    });
    return std::move(pass_);
  }

 private:
  void add(const ros_io::MonoImage& image) {
    mapping::MonoFrame frame;
    frame.time_s = image.time_s;
    frame.image = image.rectified;
    frame.readout_s = recording_.readout_s();
    if (!pass_.results.empty()) {
      const double before_s = pass_.results.back().time_s;
      frame.turn = turnBetween(imu_, before_s, image.time_s, R_camera_imu_, params_.measured);
      if (wheels_) frame.velocity = velocityByWheels(before_s, image.time_s);
    }
    const double start_ms = processorTime_ms();
    pass_.results.push_back(slam_.process(frame));
    pass_.timings.emplace_back();
    pass_.timings.back().frame_ms = processorTime_ms() - start_ms;
    if (pass_.results.back().state == MonoResult::State::kTracking) measurePieces();
  }

  std::optional<mapping::MeasuredVelocity> velocityByWheels(double from_s, double to_s) const {
    const auto before = eval::poseAt(recording_.wheels(), from_s);
    const auto now = eval::poseAt(recording_.wheels(), to_s);
    if (!before || !now) return std::nullopt;
    const Eigen::Isometry3d& T_base_camera = recording_.T_base_camera();
    return mapping::velocityOf((*before * T_base_camera).inverse() * *now * T_base_camera, to_s - from_s,
                               params_.measured);
  }

  /// Pieces as eval::neesOver() cuts them.
  void measurePieces() {
    const std::size_t frame = pass_.results.size() - 1;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      Piece& piece = pieces_[k];
      const double interval_s = eval::kNeesIntervals_s[k];
      const bool begun = piece.past_id.has_value();
      if (begun && pass_.results[frame].time_s < pass_.results[piece.from].time_s + interval_s - 1e-3)
        continue;
      if (begun) pass_.pieces[{piece.from, frame}] = slam_.sincePastPose(*piece.past_id).covariance;
      piece = {frame, slam_.renewPastPose(piece.past_id)};
    }
  }

  struct Piece {
    std::size_t from = 0;
    std::optional<int> past_id;
  };

  const mapping::MonoParams& params_;
  const ros_io::MonoRecording& recording_;
  mapping::MonoSlam slam_;
  bool wheels_;
  RotationHistory imu_{std::numeric_limits<double>::infinity()};
  Eigen::Matrix3d R_camera_imu_ = Eigen::Matrix3d::Identity();
  std::array<Piece, eval::kNeesIntervals_s.size()> pieces_;
  MonoPass pass_;
};

/// m per unit of the map, from the similarity that lays the path onto the ground truth (Umeyama 1991); 1
/// without ground truth.
double fittedScale(const std::vector<MonoResult>& results, const Trajectory& truth,
                   const Eigen::Isometry3d& T_base_camera) {
  std::vector<Eigen::Vector3d> from, to;
  for (const MonoResult& result : results) {
    const auto T_world_base = eval::poseAt(truth, result.time_s);
    if (!T_world_base || result.state != MonoResult::State::kTracking) continue;
    from.push_back(result.camera.p_world);
    to.emplace_back(*T_world_base * T_base_camera.translation());
  }
  if (from.size() < 3) return 1.0;
  Eigen::Matrix3Xd source(3, from.size()), target(3, to.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    source.col(static_cast<Eigen::Index>(i)) = from[i];
    target.col(static_cast<Eigen::Index>(i)) = to[i];
  }
  const Eigen::Matrix4d T = Eigen::umeyama(source, target, true);
  return std::cbrt(T.topLeftCorner<3, 3>().determinant());
}

Matrix6d inMetres(const Matrix6d& covariance, double scale_m) {
  Vector6d factors = Vector6d::Ones();
  factors.head<3>().setConstant(scale_m);
  return factors.asDiagonal() * covariance * factors.asDiagonal();
}

eval::FrameRecord recordOf(MonoResult result, const Eigen::Isometry3d& T_base_camera, double scale_m) {
  result.camera.p_world *= scale_m;
  result.pose_covariance = inMetres(result.pose_covariance, scale_m);
  const mapping::UncertainBase base = basePoseOf(result, T_base_camera);
  eval::FrameRecord record;
  record.time_s = result.time_s;
  if (result.state == MonoResult::State::kTracking) record.T_odom_base = base.T_odom_base;
  record.pose_covariance = base.covariance;
  record.reason = result.reason;
  record.features = static_cast<unsigned>(result.searched.size());
  record.inliers = static_cast<unsigned>(result.inliers);
  return record;
}

}  // namespace

EvaluationRun runMonoEvaluation(const EvaluateOptions& options,
                                const std::function<void(std::size_t, std::size_t)>& progress) {
  mapping::MonoParams params;
  readParameters(loadYamlFile(options.config), options.config, params);
  const ros_io::MonoRecording recording(
      options.bag, {options.part.start_s, options.part.duration_s, options.part.rolling_shutter_s});
  const Eigen::Isometry3d& T_base_camera = recording.T_base_camera();
  EvaluationRun run;
  run.input.input = std::filesystem::path(options.bag).filename().string();
  run.input.config = std::filesystem::path(options.config).filename().string();
  run.input.T_base_camera = T_base_camera;
  run.input.notes = recording.robot().notes();
  run.input.imu_set_aside = recording.imu().set_aside;
  run.input.ground_truth = truthOfBase(options, recording.robot()).trajectory;
  run.input.truth_sigma_m = options.truth_sigma_m;
  run.input.truth_sigma_rad = options.truth_sigma_deg / kDegPerRad;
  run.input.segment_lengths_m = options.segment_lengths_m;
  const bool imu = !options.no_imu && !options.no_prior;
  for (int repetition = 0; repetition < options.repeat; ++repetition) {
    MonoPass pass = MonoFeed(params, recording, imu, !options.no_prior).run(progress);
    run.timings.insert(run.timings.end(), pass.timings.begin(), pass.timings.end());
    if (repetition > 0) continue;
    double scale_m = 1.0;
    if (!pass.results.back().scale_known) {
      scale_m = fittedScale(pass.results, run.input.ground_truth, T_base_camera);
      run.input.notes.push_back(fmt::format(
          "the scale is arbitrary, nothing recorded tells it: the path is multiplied by {:.4g}, which lays it onto the "
          "ground truth; the errors are those after similarity",
          scale_m));
    }
    for (std::size_t i = 0; i < pass.results.size(); ++i) {
      run.input.frames.push_back(recordOf(pass.results[i], T_base_camera, scale_m));
      run.input.frames.back().clock_offset_s = recording.robot().clock().offset_s(pass.results[i].time_s);
      run.input.frames.back().timing = pass.timings[i];
    }
    run.input.relative_covariance = [pieces = std::move(pass.pieces), scale_m, T_base_camera](
                                        std::size_t from, std::size_t to) -> Matrix6d {
      const auto found = pieces.find({from, to});
      if (found == pieces.end()) return Matrix6d::Constant(std::numeric_limits<double>::quiet_NaN());
      return mapping::atBase(inMetres(found->second, scale_m), T_base_camera);
    };
  }
  return run;
}

}  // namespace stereo_nav::tools
