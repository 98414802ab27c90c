#include "odometry/stereo/window_optimizer.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "core/gauss_newton.h"
#include "vision/reprojection.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kLeastInverseDepth = 1e-4;  ///< 1/m
constexpr Eigen::Index kNone = -1;
/// Number of the latest frames in which the motion between the two stamps is still a variable. In older ones
/// the frames around them have settled it: to keep it free costs a quarter of the time and brings nothing.
constexpr std::size_t kFreeTimeOffsets = 6;

/// First variable of a frame's pose; the first frame is held.
Eigen::Index poseAt(int frame) {
  return frame == 0 ? kNone : 6 * (frame - 1);
}

}  // namespace

void WindowOptimizerParams::describe(ParameterVisitor& visitor) {
  visitor.integer("iterations", iterations, {0, 100}, "", "Gauss-Newton iterations per frame");
  visitor.real("loss_px", loss_px, {0.01, 100.0}, "px", "scale of the Cauchy loss on reprojection errors");
}

void WindowOptimizer::addLandmark(const std::vector<WindowFrame>& window, const Landmark& landmark,
                                  std::size_t index) {
  const double depth_m = 1.0 / landmark.ray_depth.z();
  const Eigen::Vector3d p_world = landmark.p_world();
  // d p_world / d (x/z, y/z, 1/z)
  Eigen::Matrix3d by_ray_depth = landmark.T_world_anchor.linear() * depth_m;
  by_ray_depth.col(2) = (landmark.T_world_anchor.translation() - p_world) * depth_m;

  Elimination elimination{index, blocks_.size(), 0, Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()};
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  bool seen = false;
  vision::ViewResidual residual;
  for (const LandmarkView& view : landmark.views) {
    const WindowFrame& frame = window[static_cast<std::size_t>(view.frame)];
    if (!vision::viewResidual(calibration_, frame.view, p_world, view.seen, residual)) continue;
    seen = true;
    const double weight = vision::robustWeight(residual.error_px, view.seen.noise, params_.loss_px);
    const Eigen::Matrix<double, 4, 3> by_landmark =
        residual.by_camera_point * (frame.view.T_camera_world.linear() * by_ray_depth);
    const Eigen::Matrix<double, 4, 3> weighted = weight * by_landmark;
    information.noalias() += weighted.transpose() * by_landmark;
    elimination.gradient.noalias() += weighted.transpose() * residual.error_px;
    const Eigen::Index pose = poseAt(view.frame);
    const Eigen::Matrix<double, 4, 6> weighted_pose = weight * residual.by_pose;
    if (pose != kNone) {
      information_.block<6, 6>(pose, pose).noalias() += weighted_pose.transpose() * residual.by_pose;
      gradient_.segment<6>(pose).noalias() += weighted_pose.transpose() * residual.error_px;
      blocks_.push_back({pose, weighted_pose.transpose() * by_landmark});
    }
    const Eigen::Index late = late_at_[static_cast<std::size_t>(view.frame)];
    if (late == kNone || !view.seen.has_right) continue;
    const Eigen::Matrix<double, 2, 6> weighted_late = weight * residual.by_late;
    information_.block<6, 6>(late, late).noalias() += weighted_late.transpose() * residual.by_late;
    gradient_.segment<6>(late).noalias() += weighted_late.transpose() * residual.error_px.tail<2>();
    if (pose != kNone) {
      information_.block<6, 6>(late, pose).noalias() +=
          weighted_late.transpose() * residual.by_pose.bottomRows<2>();
    }
    blocks_.push_back({late, weighted_late.transpose() * by_landmark.bottomRows<2>()});
  }
  if (!seen) return;
  elimination.blocks = blocks_.size() - elimination.first_block;
  // Slight damping, so that a landmark seen without parallax keeps its depth.
  information.diagonal() *= 1.0 + 1e-4;
  information.diagonal().array() += 1e-6;
  elimination.inverse_information = information.inverse();
  eliminations_.push_back(elimination);
}

void WindowOptimizer::addTimeOffsetPriors(const std::vector<WindowFrame>& window) {
  for (std::size_t f = 0; f < window.size(); ++f) {
    const Eigen::Index late = late_at_[f];
    if (late == kNone) continue;
    const WindowFrame& frame = window[f];
    const Vector6d residual = logMotion(frame.view.T_late_camera * frame.T_late_expected.inverse());
    // Image residuals are weighted as if their noise were 1 px, and so are the priors.
    const Vector6d weight = (vision::kPixelSigma_px * frame.late_sigma.cwiseInverse()).array().square();
    information_.diagonal().segment<6>(late) += weight;
    gradient_.segment<6>(late) += weight.cwiseProduct(residual);
  }
}

void WindowOptimizer::eliminate(const Elimination& elimination) {
  const CrossBlock* const first = blocks_.data() + elimination.first_block;
  for (std::size_t i = 0; i < elimination.blocks; ++i) {
    const CrossBlock& row = first[i];
    const Eigen::Matrix<double, 6, 3> scaled = row.information * elimination.inverse_information;
    gradient_.segment<6>(row.at).noalias() -= scaled * elimination.gradient;
    // Only the lower triangle is solved from.
    for (std::size_t j = 0; j <= i; ++j) {
      const CrossBlock& column = first[j];
      if (row.at >= column.at) {
        information_.block<6, 6>(row.at, column.at).noalias() -= scaled * column.information.transpose();
      } else {
        information_.block<6, 6>(column.at, row.at).noalias() -= column.information * scaled.transpose();
      }
    }
  }
}

bool WindowOptimizer::linearise(const std::vector<WindowFrame>& window,
                                const std::vector<Landmark>& landmarks) {
  auto size = static_cast<Eigen::Index>(6 * (window.size() - 1));
  late_at_.assign(window.size(), kNone);
  for (std::size_t f = 0; f < window.size(); ++f) {
    if (!window[f].has_time_offset || f + kFreeTimeOffsets < window.size()) continue;
    late_at_[f] = size;
    size += 6;
  }
  information_.setZero(size, size);
  gradient_.setZero(size);
  eliminations_.clear();
  blocks_.clear();
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    if (landmarks[i].views.size() >= 2) addLandmark(window, landmarks[i], i);
  }
  for (const Elimination& elimination : eliminations_) eliminate(elimination);
  addTimeOffsetPriors(window);
  information_.diagonal().array() += 1e-6;
  return !eliminations_.empty();
}

void WindowOptimizer::apply(const Eigen::VectorXd& step, std::vector<WindowFrame>& window,
                            std::vector<Landmark>& landmarks) const {
  for (std::size_t f = 0; f < window.size(); ++f) {
    vision::StereoView& view = window[f].view;
    if (f > 0) {
      const Vector6d twist = step.segment<6>(poseAt(static_cast<int>(f)));
      view.T_camera_world = renormalised(expMotion(twist) * view.T_camera_world);
    }
    if (late_at_[f] == kNone) continue;
    const Vector6d twist = step.segment<6>(late_at_[f]);
    view.T_late_camera = renormalised(expMotion(twist) * view.T_late_camera);
  }
  for (const Elimination& elimination : eliminations_) {
    Eigen::Vector3d gradient = elimination.gradient;
    for (std::size_t i = 0; i < elimination.blocks; ++i) {
      const CrossBlock& block = blocks_[elimination.first_block + i];
      gradient.noalias() += block.information.transpose() * step.segment<6>(block.at);
    }
    Eigen::Vector3d& ray_depth = landmarks[elimination.landmark].ray_depth;
    const Eigen::Vector3d change = elimination.inverse_information * gradient;
    ray_depth.head<2>() -= change.head<2>();
    // A step never passes infinity, and at most doubles or halves the inverse depth.
    ray_depth.z() = std::clamp(ray_depth.z() - change.z(), std::max(kLeastInverseDepth, 0.5 * ray_depth.z()),
                               std::max(kLeastInverseDepth, 2.0 * ray_depth.z()));
  }
}

bool WindowOptimizer::optimise(std::vector<WindowFrame>& window, std::vector<Landmark>& landmarks) {
  factors_.reset();
  if (window.size() < 2) return false;
  for (int iteration = 0; iteration < params_.iterations; ++iteration) {
    if (!linearise(window, landmarks)) return false;
    factors_.emplace(information_);
    const auto step = gaussNewtonStep(*factors_, gradient_);
    if (!step) {
      factors_.reset();
      return false;
    }
    apply(*step, window, landmarks);
  }
  return true;
}

std::optional<Matrix6d> WindowOptimizer::newestCovariance(const std::vector<WindowFrame>& window,
                                                          std::size_t since) const {
  const auto newest = static_cast<Eigen::Index>(6 * (window.size() - 2));
  if (!factors_ || window.size() < 2 || factors_->rows() < newest + 6) return std::nullopt;
  // T_newest_since changes by the one perturbation and, carried there, against the other.
  Eigen::MatrixXd by_motion = Eigen::MatrixXd::Zero(factors_->rows(), 6);
  by_motion.middleRows<6>(newest).setIdentity();
  if (since > 0) {
    const Eigen::Isometry3d T_newest_since =
        window.back().view.T_camera_world * window[since].view.T_camera_world.inverse();
    by_motion.middleRows<6>(poseAt(static_cast<int>(since))) = -adjoint(T_newest_since).transpose();
  }
  const Matrix6d covariance = by_motion.transpose() * factors_->solve(by_motion);
  if (!covariance.allFinite()) return std::nullopt;
  return Matrix6d(0.5 * (covariance + covariance.transpose()));
}

}  // namespace stereo_nav::odometry
