#include "eval/truth_frame.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <vector>

#include "core/point_alignment.h"
#include "eval/alignment.h"
#include "stereo_nav/core/trajectory.h"

namespace stereo_nav::eval {
namespace {

constexpr double kSmallAte = 0.05;              ///< of the path: the positions fit
constexpr double kHugeRelative_percent = 20.0;  ///< no odometry whose positions fit is that wrong
/// What may remain of the error where another frame explains it: that of the camera, or one whose place is
/// not known, but how it is turned.
constexpr double kMostOfCamera = 0.25;
constexpr double kMostOfTurn = 0.5;

bool positionsFitAxesDoNot(const EvaluationSummary& summary) {
  return summary.ate_rmse_m < kSmallAte * summary.path_length_m &&
         summary.rpe_translation_percent > kHugeRelative_percent;
}

/// By which the axes of the ground truth's body are turned against those of base_link, positions laid
/// together: mean over all frames.
Eigen::Isometry3d turnOfTruth(const EvaluationInput& input) {
  std::vector<Eigen::Vector3d> p_odom, p_world;
  std::vector<Eigen::Matrix3d> R_odom_base, R_world_body;
  for (const FrameRecord& frame : input.frames) {
    const auto T_world_body = poseAt(input.ground_truth, frame.time_s);
    if (!frame.T_odom_base || !T_world_body) continue;
    p_odom.push_back(frame.T_odom_base->translation());
    p_world.push_back(T_world_body->translation());
    R_odom_base.push_back(frame.T_odom_base->linear());
    R_world_body.push_back(T_world_body->linear());
  }
  const Eigen::Matrix3d R_odom_world = alignRigidly(p_odom, p_world).linear().transpose();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < R_odom_base.size(); ++i)
    sum += R_odom_base[i].transpose() * R_odom_world * R_world_body[i];
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = svd.matrixU().determinant() * svd.matrixV().determinant();
  Eigen::Isometry3d T_base_body = Eigen::Isometry3d::Identity();
  T_base_body.linear() =
      svd.matrixU() * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
  return T_base_body;
}

/// The share of the relative error that remains where the ground truth is that of this body.
double remainingError(EvaluationInput input, const EvaluationSummary& summary,
                      const Eigen::Isometry3d& T_base_body) {
  input.ground_truth = ofOtherBody(input.ground_truth, T_base_body.inverse());
  return evaluate(input).summary.rpe_translation_percent / summary.rpe_translation_percent;
}

}  // namespace

std::optional<std::string> wrongTruthFrame(const EvaluationInput& input, const EvaluationSummary& summary) {
  if (!positionsFitAxesDoNot(summary)) return std::nullopt;
  const bool is_camera = remainingError(input, summary, input.T_base_camera) < kMostOfCamera;
  if (!is_camera && !(remainingError(input, summary, turnOfTruth(input)) < kMostOfTurn)) return std::nullopt;
  const std::string figures = fmt::format(
      "the ground truth's positions fit (ATE {:.1f} % of the path), its axes do not (relative error {:.0f} %)",
      100.0 * summary.ate_rmse_m / summary.path_length_m, summary.rpe_translation_percent);
  const std::string frame = input.camera_frame.empty() ? "CAMERA_FRAME" : input.camera_frame;
  return figures +
         (is_camera
              ? ": it gives the poses of the left camera, not of base_link; use --ground-truth-frame " + frame
              : ": it gives the poses of another frame than base_link; name it by --ground-truth-frame "
                "FRAME, with its transform from base_link in tf_static");
}

}  // namespace stereo_nav::eval
