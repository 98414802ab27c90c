#include "mapping/mono/mono_slam.h"

#include <gtest/gtest.h>

#include <numeric>

#include "point_world.h"
#include "stereo_nav/core/input_error.h"
#include "support/trajectories.h"
#include "two_walls.h"

namespace stereo_nav::mapping {
namespace {

constexpr double kFrame_s = 0.04;

/// Sideways, up and down before the back wall, with some turning: as a hand holds a camera.
Eigen::Isometry3d handHeld(double time_s) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << 0.5 * std::sin(0.9 * time_s), 0.15 * std::sin(1.7 * time_s),
      0.3 * (1.0 - std::cos(0.6 * time_s));
  T.linear() =
      expRotation({0.05 * std::sin(1.3 * time_s), -0.12 * std::sin(0.8 * time_s), 0.05 * std::sin(time_s)});
  return T;
}

MonoFrame frameAt(double time_s) {
  const MonoCamera camera = test::smallCamera();
  MonoFrame frame;
  frame.time_s = time_s;
  static const test::TwoWalls walls;
  frame.image = walls.render(camera, handHeld(time_s));
  return frame;
}

/// What a board in the first image would give: corners of the texture or not.
std::vector<KnownPoint> knownPoints() {
  std::vector<KnownPoint> points;
  for (const double u : {60.0, 130.0, 200.0, 260.0}) {
    for (const double v : {50.0, 120.0, 190.0}) {
      const Eigen::Vector3d ray = test::smallCamera().ray({u, v});
      points.push_back({test::TwoWalls().depth(ray) * ray, {u, v}});
    }
  }
  return points;
}

TEST(MonoSlam, FromKnownPointsThePathHasTheirScale) {
  MonoSlam slam(MonoParams(), test::smallCamera());
  slam.start(frameAt(0.0), knownPoints());
  double squares = 0.0;
  int frames = 0;
  for (double time_s = kFrame_s; time_s < 4.0; time_s += kFrame_s, ++frames) {
    const MonoResult result = slam.process(frameAt(time_s));
    ASSERT_EQ(result.state, MonoResult::State::kTracking) << time_s << ": " << result.reason;
    EXPECT_TRUE(result.scale_known);
    squares += (result.camera.p_world - handHeld(time_s).translation()).squaredNorm();
  }
  EXPECT_LT(std::sqrt(squares / frames), 0.02);
}

TEST(MonoSlam, WithoutAScaleThePathHasTheRightShape) {
  MonoSlam slam(MonoParams(), test::smallCamera());
  std::vector<Eigen::Vector3d> estimate, truth;
  MonoResult result;
  for (double time_s = 0.0; time_s < 4.0; time_s += kFrame_s) {
    result = slam.process(frameAt(time_s));
    estimate.push_back(result.camera.p_world);
    truth.push_back(handHeld(time_s).translation());
  }
  EXPECT_FALSE(result.scale_known);
  EXPECT_EQ(result.state, MonoResult::State::kTracking);
  Eigen::Matrix3Xd from(3, estimate.size()), to(3, truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = estimate[i];
    to.col(static_cast<Eigen::Index>(i)) = truth[i];
  }
  const Eigen::Matrix4d S = Eigen::umeyama(from, to, true);
  const Eigen::Matrix3Xd error =
      ((S.topLeftCorner<3, 3>() * from).colwise() + Eigen::Vector3d(S.topRightCorner<3, 1>())) - to;
  EXPECT_LT(std::sqrt(error.squaredNorm() / static_cast<double>(truth.size())), 0.05);
}

TEST(MonoSlam, VelocitiesGiveTheScale) {
  MonoSlam slam(MonoParams(), test::smallCamera());
  MonoResult result;
  for (double time_s = 0.0; time_s < 4.0; time_s += kFrame_s) {
    MonoFrame frame = frameAt(time_s);
    const Eigen::Isometry3d T_before_after = handHeld(time_s - 0.01).inverse() * handHeld(time_s + 0.01);
    frame.velocity =
        MeasuredVelocity{T_before_after.translation() / 0.02, 1e-4 * Eigen::Matrix3d::Identity()};
    result = slam.process(frame);
  }
  EXPECT_TRUE(result.scale_known);
  EXPECT_LT((result.camera.p_world - handHeld(4.0 - kFrame_s).translation()).norm(), 0.05);
}

TEST(MonoSlam, TwoRunsGiveTheSameBits) {
  const auto last = [] {
    MonoSlam slam(MonoParams(), test::smallCamera());
    MonoResult result;
    for (double time_s = 0.0; time_s < 0.5; time_s += kFrame_s) result = slam.process(frameAt(time_s));
    return result;
  };
  const MonoResult first = last(), second = last();
  EXPECT_EQ(first.camera.p_world, second.camera.p_world);
  EXPECT_EQ(first.pose_covariance, second.pose_covariance);
}

TEST(MonoSlam, ACoveredCameraIsSaidAndTheMapIsFoundAgain) {
  MonoSlam slam(MonoParams(), test::smallCamera());
  slam.start(frameAt(0.0), knownPoints());
  for (double time_s = kFrame_s; time_s < 1.0; time_s += kFrame_s) slam.process(frameAt(time_s));
  MonoFrame covered = frameAt(1.0);
  covered.image.setTo(40);
  MonoResult result;
  for (int i = 0; i < 5; ++i) {
    covered.time_s = 1.0 + i * kFrame_s;
    result = slam.process(covered);
    EXPECT_EQ(result.state, MonoResult::State::kCoasting);
    EXPECT_NE(result.reason.find("is the camera covered"), std::string::npos);
  }
  for (double time_s = 1.0 + 5.0 * kFrame_s; time_s < 2.0; time_s += kFrame_s)
    result = slam.process(frameAt(time_s));
  EXPECT_EQ(result.state, MonoResult::State::kTracking);
  EXPECT_LT((result.camera.p_world - handHeld(result.time_s).translation()).norm(), 0.05);
}

TEST(MonoSlam, AfterALossANewMapBegins) {
  MonoSlam slam(MonoParams(), test::smallCamera());
  slam.start(frameAt(0.0), knownPoints());
  slam.process(frameAt(kFrame_s));
  MonoFrame covered = frameAt(0.1);
  covered.image.setTo(40);
  MonoResult result;
  for (int i = 0; i < 30 && result.state != MonoResult::State::kLost; ++i) {
    covered.time_s = 0.1 + i * kFrame_s;
    result = slam.process(covered);
  }
  EXPECT_EQ(result.state, MonoResult::State::kLost);
  for (double time_s = 2.0; time_s < 3.0; time_s += kFrame_s) result = slam.process(frameAt(time_s));
  EXPECT_EQ(result.state, MonoResult::State::kTracking);
  EXPECT_FALSE(result.scale_known);
}

TEST(MonoSlam, TheMapKeepsItsBudget) {
  MonoParams params;
  params.most_landmarks = 20;
  params.most_measured = 12;
  MonoSlam slam(params, test::smallCamera());
  for (double time_s = 0.0; time_s < 1.0; time_s += kFrame_s) {
    const MonoResult result = slam.process(frameAt(time_s));
    EXPECT_LE(result.landmarks, 20U);
    EXPECT_LE(result.searched.size(), 12U);
  }
}

TEST(MonoSlam, AnImageOfAnotherSizeIsNamed) {
  MonoSlam slam(MonoParams(), test::smallCamera());
  MonoFrame frame;
  frame.image = cv::Mat::zeros(480, 640, CV_8UC1);
  EXPECT_NE(messageOf<InputError>([&] { slam.process(frame); }).find("640x480"), std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::mapping
