#pragma once

#include <Eigen/Cholesky>
#include <cstdint>
#include <optional>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"
#include "vision/stereo_view.h"

namespace stereo_nav::odometry {

struct WindowOptimizerParams {
  int iterations = 2;
  double loss_px = 0.2;

  void describe(ParameterVisitor& visitor);
};

/// A frame of the window. If its two images have different stamps, the motion between them is a variable of
/// its own, tied to what the frames around it predict.
struct WindowFrame {
  vision::StereoView view;
  bool has_time_offset = false;  ///< between the left and the right image
  Eigen::Isometry3d T_late_expected = Eigen::Isometry3d::Identity();
  Vector6d late_sigma = Vector6d::Ones();  ///< of the left perturbation of T_late_camera: m, rad
};

/// The observation of a landmark by one frame of the window.
struct LandmarkView {
  int frame = 0;  ///< index into the window
  vision::StereoObservation seen;
};

/// A point of the map: the pixel ray and inverse depth in the camera that saw it first, at the pose that this
/// camera was given then. These parameters of a point in the world are as good at infinity as near by
/// (Civera, Davison and Montiel 2008). The anchor is not refined.
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
/// 2000). The first frame is held, since an odometry has no other origin.
class WindowOptimizer {
 public:
  WindowOptimizer(const WindowOptimizerParams& params, const vision::StereoCalibration& calibration)
      : params_(params), calibration_(calibration) {}

  /// Refines the poses of `window`, all but the first, and the landmarks. Returns false, and leaves both as
  /// they are, if the observations do not determine them.
  bool optimise(std::vector<WindowFrame>& window, std::vector<Landmark>& landmarks);

  /// Covariance of the newest frame's pose relative to the frame `since` of the window, as the last
  /// optimise() found it, for pixels of unit variance: of the left perturbation of T_newest_since, m, rad.
  /// Nothing where it is unknown.
  std::optional<Matrix6d> newestCovariance(const std::vector<WindowFrame>& window, std::size_t since) const;

 private:
  struct Elimination {
    std::size_t landmark;
    std::size_t first_block;  ///< into blocks_
    std::size_t blocks;
    Eigen::Matrix3d inverse_information;
    Eigen::Vector3d gradient;
  };
  /// Block of the information matrix that couples six camera variables and a landmark.
  struct CrossBlock {
    Eigen::Index at;  ///< first of the camera variables
    Eigen::Matrix<double, 6, 3> information;
  };
  bool linearise(const std::vector<WindowFrame>& window, const std::vector<Landmark>& landmarks);
  void addLandmark(const std::vector<WindowFrame>& window, const Landmark& landmark, std::size_t index);
  void addTimeOffsetPriors(const std::vector<WindowFrame>& window);
  void eliminate(const Elimination& elimination);
  void apply(const Eigen::VectorXd& step, std::vector<WindowFrame>& window,
             std::vector<Landmark>& landmarks) const;

  WindowOptimizerParams params_;
  vision::StereoCalibration calibration_;
  Eigen::MatrixXd information_;  ///< reduced camera system, lower blocks
  Eigen::VectorXd gradient_;
  /// Of information_ in the last step; nothing where the last optimise() did not determine it.
  std::optional<Eigen::LDLT<Eigen::MatrixXd>> factors_;
  std::vector<Elimination> eliminations_;
  std::vector<CrossBlock> blocks_;
  std::vector<Eigen::Index> late_at_;  ///< first variable of T_late_camera per frame; negative without one
};

}  // namespace stereo_nav::odometry
