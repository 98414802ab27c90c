#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <optional>

#include "mapping/mono/inverse_depth.h"
#include "mapping/mono/mono_landmarks.h"
#include "mapping/mono/mono_update.h"
#include "point_world.h"

namespace stereo_nav::mapping {
namespace {

constexpr double kFilterStep_s = 0.04;
constexpr int kFrames = 100;
constexpr int kFramesOfPiece = 25;  // 1 s
constexpr double kPixelSigma_px = 0.5;

/// The filter alone, on points whose pixels have exactly the noise it expects, and a camera that moves as it
/// expects. The scale is that of eight points known beforehand.
class FilterRun {
 public:
  explicit FilterRun(unsigned seed) : random_(seed), state_(kCameraRows + 6 + 6 * 80) {
    points_ = test::pointsBefore(120, random_);
    truth_.v_world = test::noiseVector(0.1, random_);
    truth_.omega_camera = test::noiseVector(0.1, random_);
    Matrix12d P = 1e-10 * Matrix12d::Identity();
    P.diagonal().tail<6>().setConstant(0.01);
    state_.covariance.start(P);
    block_of_point_.resize(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (known_ == 8 || !pixelOfPoint(i)) continue;
      block_of_point_[i] = addKnownPoint(state_, points_[i], 1e-3).id;
      points_[i] += test::noiseVector(1e-3, random_);
      ++known_;
    }
  }

  /// Sum of e^T P^-1 e over the pieces, and their number.
  std::pair<double, int> nees() {
    double sum = 0.0;
    int pieces = 0;
    seeNewPoints();
    for (int frame = 0; frame < kFrames; ++frame) {
      if (frame % kFramesOfPiece == 0) {
        if (frame > 0) {
          sum += squaredError();
          ++pieces;
          state_.remove(blockWith(past_id_));
        }
        past_id_ = addPastPose(state_);
        T_world_past_ = truth_.T_world_camera();
      }
      step();
    }
    return {sum, pieces};
  }

 private:
  std::optional<Eigen::Vector2d> pixelOfPoint(std::size_t i) const {
    StateBlock point;
    point.value.head<3>() = points_[i];
    const auto px = pixelOf(camera_, truth_, point, 0.0);
    return px && camera_.sees(*px, 0.0) ? px : std::nullopt;
  }

  Eigen::Vector2d noisy(const Eigen::Vector2d& px) {
    return px + test::noiseVector(kPixelSigma_px, random_).head<2>();
  }

  std::size_t blockWith(int id) const {
    for (std::size_t i = 0; i < state_.blocks.size(); ++i) {
      if (state_.blocks[i].id == id) return i;
    }
    return state_.blocks.size();
  }

  void seeNewPoints() {
    int seen = 0;
    for (std::size_t i = 0; i < points_.size() && seen < 30; ++i) {
      const auto px = pixelOfPoint(i);
      if (!px) continue;
      ++seen;
      if (block_of_point_[i] || state_.blocks.size() > 78) continue;
      block_of_point_[i] = addInverseDepth(state_, camera_, noisy(*px), kPixelSigma_px, {0.3, 0.15}, 0.0).id;
    }
  }

  void step() {
    truth_ = test::strayed(truth_, kFilterStep_s, noise_, random_);
    predict(state_, kFilterStep_s, noise_);
    std::vector<PixelMatch> matches;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto px = pixelOfPoint(i);
      if (!px || !block_of_point_[i]) continue;
      const std::size_t block = blockWith(*block_of_point_[i]);
      const auto expected = expectedPixel(camera_, state_.camera, state_.blocks[block], 0.0);
      if (expected) matches.push_back({block, *expected, noisy(*px)});
    }
    EXPECT_TRUE(correctByPixels(state_, matches, kPixelSigma_px));
    convertToPoints(state_, 0.1);
    seeNewPoints();
  }

  double squaredError() const {
    const RelativePose relative = relativeTo(state_, state_.blocks[blockWith(past_id_)]);
    const Vector6d error =
        logMotion(relative.T_past_now.inverse() * T_world_past_.inverse() * truth_.T_world_camera());
    return error.dot(relative.covariance.ldlt().solve(error));
  }

  std::mt19937 random_;
  MonoCamera camera_ = test::smallCamera();
  MotionNoise noise_{0.15, 0.15};
  MonoState state_;
  CameraState truth_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::optional<int>> block_of_point_;
  int known_ = 0;
  int past_id_ = 0;
  Eigen::Isometry3d T_world_past_ = Eigen::Isometry3d::Identity();
};

TEST(MonoNees, RelativePosesOverASecondAreAsWrongAsTheirCovariancesSay) {
  double sum = 0.0;
  int pieces = 0;
  for (unsigned seed = 1; seed <= 15; ++seed) {
    const auto [run_sum, run_pieces] = FilterRun(seed).nees();
    sum += run_sum;
    pieces += run_pieces;
  }
  // Of right covariances 1, with a standard deviation of sqrt(2 / (6 * 45)) = 0.09.
  EXPECT_GT(sum / (6.0 * pieces), 0.5);
  EXPECT_LT(sum / (6.0 * pieces), 2.0);
}

}  // namespace
}  // namespace stereo_nav::mapping
