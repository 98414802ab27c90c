#include "eval/metrics.h"

#include <cmath>

#include "support/trajectories.h"

namespace stereo_nav::eval {
namespace {

Poses straight(std::size_t count, double step_m, double yaw_step_deg = 0.0) {
  Poses poses;
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<double>(i);
    poses.push_back(pose(n * step_m, 0, 0, n * yaw_step_deg));
  }
  return poses;
}

TEST(SegmentLengths, thoseBetweenATwelfthAndAHalfOfThePath) {
  EXPECT_EQ(segmentLengths(3.3), (std::vector<double>{0.5, 1.0}));
  EXPECT_EQ(segmentLengths(59.8597), (std::vector<double>{5.0, 10.0, 20.0}));
  EXPECT_EQ(segmentLengths(12.0), (std::vector<double>{1.0, 2.0, 5.0}));  // a twelfth is 1: included
  EXPECT_EQ(segmentLengths(10.0), (std::vector<double>{1.0, 2.0, 5.0}));  // a half is 5: included
  EXPECT_TRUE(segmentLengths(0.9).empty());
  EXPECT_TRUE(segmentLengths(0.0).empty());
}

TEST(RelativeError, tenPercentTooLongIsTenPercent) {
  const auto error = relativeError(straight(11, 1.0), straight(11, 1.1), {1.0, 2.0, 5.0});
  EXPECT_NEAR(error.translation_percent, 10.0, 1e-9);
  EXPECT_NEAR(error.rotation_deg_per_m, 0.0, 1e-9);
}

TEST(RelativeError, endsAtTheFirstFrameBeyondTheLengthAndDividesByTheLength) {
  // Steps of 0.4 m: 1 m is first reached after 3 steps, 1.2 m; 10 % of that is 0.12 m, 12 % of the length.
  const auto error = relativeError(straight(4, 0.4), straight(4, 0.44), {1.0});
  EXPECT_NEAR(error.translation_percent, 12.0, 1e-9);
}

TEST(RelativeError, rotationPerMetre) {
  // The estimate turns 2 degrees a metre on the spot: over 1 m 2 deg/m, over 2 m 4 deg / 2 m. In its own,
  // turned frame the second frame of each piece lies on a chord off by 2 * sin(turn / 2) * length only if i
  // is turned.
  const auto error = relativeError(straight(3, 1.0), straight(3, 1.0, 2.0), {2.0});
  EXPECT_NEAR(error.rotation_deg_per_m, 2.0, 1e-9);
  EXPECT_NEAR(error.translation_percent, 0.0, 1e-9);  // only i = 0 has 2 m ahead, and it is not turned
}

TEST(RelativeError, meanOverAllFramesAndLengths) {
  // Positions 0 1 2 3 against 0 1 2 4: over 1 m the errors are 0, 0, 1 m (0, 0, 100 %), over 2 m 0 and 1 m
  // (0, 50 %).
  auto estimate = straight(4, 1.0);
  estimate[3].translation().x() = 4.0;
  const auto error = relativeError(straight(4, 1.0), estimate, {1.0, 2.0});
  EXPECT_NEAR(error.translation_percent, (0 + 0 + 100 + 0 + 50) / 5.0, 1e-9);
}

TEST(RelativeError, doesNotDependOnTheFixedFrames) {
  auto moved = straight(8, 1.1, 3.0);
  const auto before = relativeError(straight(8, 1.0), moved, {1.0, 2.0});
  for (auto& T : moved) T = pose(7, 8, 9, 77.0) * T;
  const auto after = relativeError(straight(8, 1.0), moved, {1.0, 2.0});
  EXPECT_NEAR(before.translation_percent, after.translation_percent, 1e-9);
  EXPECT_NEAR(before.rotation_deg_per_m, after.rotation_deg_per_m, 1e-9);
}

TEST(RelativeError, unknownWhereNothingFits) {
  EXPECT_TRUE(std::isnan(relativeError(straight(3, 1.0), straight(3, 1.0), {5.0}).translation_percent));
  EXPECT_TRUE(std::isnan(relativeError(straight(3, 1.0), straight(3, 1.0), {}).rotation_deg_per_m));
  EXPECT_THROW(relativeError(straight(3, 1.0), straight(2, 1.0), {1.0}), std::invalid_argument);
}

TEST(SegmentErrors, areTakenAlongTheGivenWay) {
  const SegmentErrors by_truth =
      segmentErrors(straight(11, 1.0), straight(11, 1.1), wayTo(straight(11, 1.0)), 2.0);
  EXPECT_NEAR(by_truth.translation_percent, 10.0, 1e-9);
  EXPECT_EQ(by_truth.pairs, 9u);
  // Wheels that count half: a piece of 2 m is four steps.
  const SegmentErrors by_wheels =
      segmentErrors(straight(11, 1.0), straight(11, 1.1), wayTo(straight(11, 0.5)), 2.0);
  EXPECT_NEAR(by_wheels.translation_percent, 20.0, 1e-9);
  EXPECT_EQ(by_wheels.pairs, 7u);
  const SegmentErrors none = segmentErrors(straight(3, 1.0), straight(3, 1.0), wayTo(straight(3, 1.0)), 5.0);
  EXPECT_EQ(none.pairs, 0u);
  EXPECT_TRUE(std::isnan(none.translation_percent));
}

TEST(StepsOff, countsJumps) {
  Poses estimate = straight(6, 1.0);
  EXPECT_EQ(stepsOff(straight(6, 1.0), estimate), 0u);
  estimate[3].translation().y() += 0.4;  // there and back again
  EXPECT_EQ(stepsOff(straight(6, 1.0), estimate), 2u);
}

TEST(AngleDeg, smallAndLargeAngles) {
  EXPECT_NEAR(angleDeg(pose(0, 0, 0, 1e-7).linear()), 1e-7, 1e-12);
  EXPECT_NEAR(angleDeg(pose(0, 0, 0, -90.0).linear()), 90.0, 1e-9);
  EXPECT_NEAR(angleDeg(pose(0, 0, 0, 180.0).linear()), 180.0, 1e-6);
}

TEST(Rmse, byHand) {
  EXPECT_DOUBLE_EQ(rmse({{0, 0, 0}, {0, 0, 0}}, {{3, 4, 0}, {0, 0, 1}}), std::sqrt((25.0 + 1.0) / 2.0));
  EXPECT_THROW(rmse({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace stereo_nav::eval
