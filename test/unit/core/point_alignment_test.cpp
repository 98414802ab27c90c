#include "core/point_alignment.h"

#include "core/angles.h"
#include "support/trajectories.h"

namespace stereo_nav {
namespace {

TEST(AlignRigidly, findsTheMotionThatMovedThePoints) {
  const std::vector<Eigen::Vector3d> source = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  const Eigen::Isometry3d T = pose(4, -5, 6, 120.0) * Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitX());
  std::vector<Eigen::Vector3d> target;
  for (const auto& point : source) target.push_back(T * point);
  EXPECT_TRUE(alignRigidly(source, target).isApprox(T, 1e-12));
}

TEST(AlignRigidly, keepsTheScale) {
  // Stretched about the middle by 10 %: nothing to rotate or shift, every point stays 0.1 m off.
  const std::vector<Eigen::Vector3d> source = {{-1.1, 0, 0}, {1.1, 0, 0}, {0, -1.1, 0}, {0, 1.1, 0}};
  const std::vector<Eigen::Vector3d> target = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
  EXPECT_TRUE(alignRigidly(source, target).isApprox(Eigen::Isometry3d::Identity(), 1e-12));
}

TEST(AlignRigidly, straightLinesAndMirroredPointsStillGiveARotation) {
  const std::vector<Eigen::Vector3d> along_x = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  const std::vector<Eigen::Vector3d> along_y = {{5, 0, 0}, {5, 1, 0}, {5, 2, 0}};
  const auto T = alignRigidly(along_x, along_y);
  EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-12);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE((T * along_x[i]).isApprox(along_y[i], 1e-12));

  const std::vector<Eigen::Vector3d> corner = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  const std::vector<Eigen::Vector3d> mirrored = {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
  EXPECT_NEAR(alignRigidly(corner, mirrored).linear().determinant(), 1.0, 1e-12);

  EXPECT_TRUE(alignRigidly({{1, 2, 3}}, {{1, 2, 4}}).translation().isApprox(Eigen::Vector3d(0, 0, 1)));
  EXPECT_THROW(alignRigidly({}, {}), std::invalid_argument);
  EXPECT_THROW(alignRigidly(along_x, {{0, 0, 0}}), std::invalid_argument);
}

const std::vector<Eigen::Vector3d> kPlaces_m = {{0, 0, 0}, {4, 0, 0.5}, {3, 2, -0.5}, {-1, 3, 1}};

std::vector<Eigen::Vector3d> movedBy(const Similarity& similarity) {
  std::vector<Eigen::Vector3d> moved;
  for (const auto& place : kPlaces_m) moved.push_back(similarity * place);
  return moved;
}

TEST(AlignSimilarly, FindsScaleRotationAndTranslation) {
  Similarity truth;
  truth.scale = 1.25;
  truth.R_target_source =
      (Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  truth.t_target_m << 100, -50, 7;
  const Similarity found = alignSimilarly(kPlaces_m, movedBy(truth), {true, false});
  EXPECT_NEAR(found.scale, 1.25, 1e-12);
  EXPECT_TRUE(found.R_target_source.isApprox(truth.R_target_source, 1e-12));
  EXPECT_TRUE(found.t_target_m.isApprox(truth.t_target_m, 1e-12));
}

TEST(AlignSimilarly, TurnsAboutTheVerticalOnlyWhereToldSo) {
  Similarity truth;
  truth.R_target_source = Eigen::AngleAxisd(-3.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  truth.t_target_m << 1, 2, 3;
  auto targets = movedBy(truth);
  const Similarity exact = alignSimilarly(kPlaces_m, targets, {true, true});
  EXPECT_TRUE(exact.R_target_source.isApprox(truth.R_target_source, 1e-12));
  EXPECT_NEAR(exact.scale, 1.0, 1e-12);

  for (auto& target : targets) target = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()) * target;
  const Similarity tilted = alignSimilarly(kPlaces_m, targets, {false, true});
  EXPECT_TRUE((tilted.R_target_source * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_DOUBLE_EQ(tilted.scale, 1.0);
}

TEST(AlignSimilarly, LeavesNoBetterAngleAndScale) {
  auto targets = movedBy(Similarity());
  targets[1] += Eigen::Vector3d(0.3, -0.4, 0.2);
  const auto error = [&](const Similarity& similarity) {
    double sum = 0.0;
    for (std::size_t i = 0; i < targets.size(); ++i)
      sum += (similarity * kPlaces_m[i] - targets[i]).squaredNorm();
    return sum;
  };
  const Similarity best = alignSimilarly(kPlaces_m, targets, {true, true});
  for (const double step : {-1e-3, 1e-3}) {
    Similarity turned = best, scaled = best;
    turned.R_target_source = Eigen::AngleAxisd(step, Eigen::Vector3d::UnitZ()) * best.R_target_source;
    scaled.scale += step;
    EXPECT_GT(error(turned), error(best));
    EXPECT_GT(error(scaled), error(best));
  }
}

}  // namespace
}  // namespace stereo_nav
