#include "stereo_nav/vo/window_optimizer.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "stereo_nav/vo/pose_estimator.h"

namespace stereo_nav::vo {
namespace {

constexpr double kLeastInverseDepth = 1e-4;  ///< 1/m

}  // namespace

void WindowOptimizerParams::describe(ParameterVisitor& visitor) {
  visitor.integer("iterations", iterations, {0, 100}, "", "Gauss-Newton iterations per frame");
  visitor.real("loss_px", loss_px, {0.01, 100.0}, "px", "scale of the Cauchy loss on reprojection errors");
  visitor.real("max_error_px", max_error_px, {0.01, 100.0}, "px",
               "a view with a larger reprojection error is dropped");
}

void WindowOptimizer::addLandmark(const std::vector<StereoView>& window, const Landmark& landmark,
                                  std::size_t index) {
  const double depth_m = 1.0 / landmark.ray_depth.z();
  const Eigen::Vector3d p_world = landmark.p_world();
  // d p_world / d (x/z, y/z, 1/z)
  Eigen::Matrix3d by_ray_depth = landmark.T_world_anchor.linear() * depth_m;
  by_ray_depth.col(2) = (landmark.T_world_anchor.translation() - p_world) * depth_m;

  Elimination elimination;
  elimination.landmark = index;
  elimination.first_view = blocks_.size();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  elimination.gradient.setZero();
  ViewResidual residual;
  for (const LandmarkView& view : landmark.views) {
    const StereoView& frame = window[static_cast<std::size_t>(view.frame)];
    if (!viewResidual(calibration_, frame, p_world, view.seen, residual)) continue;
    const double weight =
        1.0 / (1.0 + residual.error_px.squaredNorm() / (params_.loss_px * params_.loss_px));
    const Eigen::Matrix<double, 4, 3> by_landmark =
        residual.by_camera_point * (frame.T_camera_world.linear() * by_ray_depth);
    const Eigen::Matrix<double, 4, 3> weighted = weight * by_landmark;
    information.noalias() += weighted.transpose() * by_landmark;
    elimination.gradient.noalias() += weighted.transpose() * residual.error_px;
    ViewBlock block;
    block.frame = view.frame;
    if (view.frame > 0) {
      const int at = 6 * (view.frame - 1);
      const Eigen::Matrix<double, 4, 6> weighted_pose = weight * residual.by_pose;
      information_.block<6, 6>(at, at).noalias() += weighted_pose.transpose() * residual.by_pose;
      gradient_.segment<6>(at).noalias() += weighted_pose.transpose() * residual.error_px;
      block.cross.noalias() = weighted_pose.transpose() * by_landmark;
    }
    blocks_.push_back(block);
  }
  elimination.views = blocks_.size() - elimination.first_view;
  if (elimination.views == 0) return;
  // A whiff of damping: a landmark seen without parallax keeps its depth.
  information.diagonal() *= 1.0 + 1e-4;
  information.diagonal().array() += 1e-6;
  elimination.inverse_information = information.inverse();
  eliminations_.push_back(elimination);
}

void WindowOptimizer::eliminate(const Elimination& elimination) {
  for (std::size_t i = 0; i < elimination.views; ++i) {
    const ViewBlock& row = blocks_[elimination.first_view + i];
    if (row.frame == 0) continue;
    const Eigen::Matrix<double, 6, 3> scaled = row.cross * elimination.inverse_information;
    const int at = 6 * (row.frame - 1);
    gradient_.segment<6>(at).noalias() -= scaled * elimination.gradient;
    for (std::size_t j = 0; j <= i; ++j) {
      const ViewBlock& column = blocks_[elimination.first_view + j];
      if (column.frame == 0) continue;
      information_.block<6, 6>(at, 6 * (column.frame - 1)).noalias() -= scaled * column.cross.transpose();
    }
  }
}

bool WindowOptimizer::linearise(const std::vector<StereoView>& window, const std::vector<Landmark>& landmarks) {
  const auto size = static_cast<Eigen::Index>(6 * (window.size() - 1));
  information_.setZero(size, size);
  gradient_.setZero(size);
  eliminations_.clear();
  blocks_.clear();
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    if (landmarks[i].views.size() >= 2) addLandmark(window, landmarks[i], i);
  }
  for (const Elimination& elimination : eliminations_) eliminate(elimination);
  return !eliminations_.empty();
}

bool WindowOptimizer::optimise(std::vector<StereoView>& window, std::vector<Landmark>& landmarks) {
  if (window.size() < 2) return false;
  for (int iteration = 0; iteration < params_.iterations; ++iteration) {
    if (!linearise(window, landmarks)) return false;
    information_.diagonal().array() += 1e-6;
    const Eigen::LDLT<Eigen::MatrixXd> solver(information_);
    if (solver.info() != Eigen::Success || !solver.isPositive()) return false;
    const Eigen::VectorXd step = solver.solve(-gradient_);
    if (!step.allFinite()) return false;
    for (std::size_t f = 1; f < window.size(); ++f) {
      StereoView& frame = window[f];
      const Vector6d twist = step.segment<6>(static_cast<Eigen::Index>(6 * (f - 1)));
      frame.T_camera_world = renormalised(expMotion(twist) * frame.T_camera_world);
    }
    for (const Elimination& elimination : eliminations_) {
      Eigen::Vector3d gradient = elimination.gradient;
      for (std::size_t i = 0; i < elimination.views; ++i) {
        const ViewBlock& block = blocks_[elimination.first_view + i];
        if (block.frame == 0) continue;
        gradient.noalias() += block.cross.transpose() * step.segment<6>(6 * (block.frame - 1));
      }
      Eigen::Vector3d& ray_depth = landmarks[elimination.landmark].ray_depth;
      const Eigen::Vector3d change = elimination.inverse_information * gradient;
      ray_depth.head<2>() -= change.head<2>();
      // Never through infinity, and not nearer than twice as near in one step.
      ray_depth.z() = std::clamp(ray_depth.z() - change.z(), std::max(kLeastInverseDepth, 0.5 * ray_depth.z()),
                                 2.0 * ray_depth.z());
    }
    if (iteration + 1 == params_.iterations) {
      const auto size = information_.rows();
      Eigen::MatrixXd last = Eigen::MatrixXd::Zero(size, 6);
      last.bottomRows<6>().setIdentity();
      last_covariance_ = solver.solve(last).bottomRows<6>();
    }
  }
  return true;
}

}  // namespace stereo_nav::vo
