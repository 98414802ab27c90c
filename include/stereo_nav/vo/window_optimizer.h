#pragma once

#include <Eigen/StdVector>
#include <vector>

#include "stereo_nav/params/parameter_visitor.h"
#include "stereo_nav/vo/stereo_view.h"

namespace stereo_nav::vo {

struct WindowOptimizerParams {
  int iterations = 2;
  double loss_px = 1.0;
  double max_error_px = 2.0;

  void describe(ParameterVisitor& visitor);
};

/// What one frame of the window saw of a landmark.
struct LandmarkView {
  int frame = 0;  ///< index into the window
  StereoObservation seen;
};

/// A point of the map: the pixel ray and inverse depth in the camera that saw it first, as that camera stood
/// then. A plain reparametrisation of a point of the world that is as good at infinity as near by (Civera,
/// Davison and Montiel 2008); the anchor is no variable.
struct Landmark {
  std::uint64_t id = 0;
  Eigen::Isometry3d T_world_anchor = Eigen::Isometry3d::Identity();
  Eigen::Vector3d ray_depth = Eigen::Vector3d::Zero();  ///< x/z, y/z, 1/z (1/m)
  std::vector<LandmarkView> views;

  Eigen::Vector3d p_world() const {
    return T_world_anchor * (Eigen::Vector3d(ray_depth.x(), ray_depth.y(), 1.0) / ray_depth.z());
  }
};

/// Bundle adjustment of a few frames and all landmarks seen from at least two of them: Gauss-Newton on the
/// stereo reprojection error with a Cauchy loss, landmarks eliminated by the Schur complement (Triggs et al.
/// 2000). The first frame is held: an odometry has no other origin.
class WindowOptimizer {
 public:
  WindowOptimizer(const WindowOptimizerParams& params, const StereoCalibration& calibration)
      : params_(params), calibration_(calibration) {}

  /// Moves the poses of `window` (all but the first) and the landmarks. Returns whether it could.
  bool optimise(std::vector<StereoView>& window, std::vector<Landmark>& landmarks);

  /// Covariance of the last frame's left perturbation (m, rad) relative to the first, for noise of 1 px.
  const Matrix6d& lastCovariance() const { return last_covariance_; }

 private:
  struct Elimination {
    std::size_t landmark;
    std::size_t first_view;  ///< into by_view_
    std::size_t views;
    Eigen::Matrix3d inverse_information;
    Eigen::Vector3d gradient;
  };
  struct ViewBlock {
    int frame;
    Eigen::Matrix<double, 6, 3> cross;  ///< between the frame's pose and the landmark
  };
  bool linearise(const std::vector<StereoView>& window, const std::vector<Landmark>& landmarks);
  void addLandmark(const std::vector<StereoView>& window, const Landmark& landmark, std::size_t index);
  void eliminate(const Elimination& elimination);

  WindowOptimizerParams params_;
  StereoCalibration calibration_;
  Eigen::MatrixXd information_;  ///< reduced camera system, lower blocks
  Eigen::VectorXd gradient_;
  std::vector<Elimination> eliminations_;
  std::vector<ViewBlock> blocks_;
  Matrix6d last_covariance_ = Matrix6d::Zero();
};

}  // namespace stereo_nav::vo
