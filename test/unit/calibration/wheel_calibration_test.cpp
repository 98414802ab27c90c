#include "calibration/wheel_calibration.h"

#include <gtest/gtest.h>

#include "core/angles.h"
#include "kinematics/layouts.h"
#include "unit/odometry/wheel/driven_wheels.h"

namespace stereo_nav::calibration {
namespace {

using kinematics::DriveParams;
using kinematics::Twist;
using odometry::DrivenWheels;
using odometry::odometryOf;

constexpr double kPeriod_s = 0.02;

Eigen::Isometry3d inSpace(const Eigen::Isometry2d& planar) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear().topLeftCorner<2, 2>() = planar.linear();
  T.translation().head<2>() = planar.translation();
  return T;
}

/// A drive of these wheels and motion capture of 1 mm and 0.1 deg, whose stamps are late and whose lengths
/// are off.
template <class TwistAt>
WheelRun driven(const DriveParams& drive, double duration_s, const TwistAt& twist_at, double late_s = 0.0,
                double scale = 1.0) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  WheelRun run;
  DrivenWheels base(drive);
  const auto read = [&] {
    run.samples.push_back(base.sample(false));
    const Eigen::Vector3d noise(1e-3 * normal(random), 1e-3 * normal(random),
                                0.1 * kRadPerDeg * normal(random));
    Eigen::Isometry2d pose = base.pose() * expPlanar(noise);
    pose.translation() *= scale;
    run.reference.push_back({run.samples.back().time_s + late_s, inSpace(pose)});
  };
  read();
  for (int i = 0; i < std::lround(duration_s / kPeriod_s); ++i) {
    base.move(twist_at(kPeriod_s * i), kPeriod_s);
    read();
  }
  return run;
}

/// Radii off by up to 2 %, positions by up to 4 mm, directions of wheels with rollers by up to 0.6 deg.
DriveParams worn(DriveParams drive) {
  double share = 1.0;
  for (auto& wheel : drive.wheels) {
    wheel.radius_m *= 1.0 + 0.02 * share;
    wheel.y_m += 0.004 * share;
    if (wheel.kind == kinematics::WheelKind::kRollers) wheel.direction_deg += 0.6 * share;
    share = share > 0.0 ? -0.7 * share : 0.1 - 0.9 * share;
  }
  return drive;
}

/// Turns of the wheels for each motion that the drive can make, against the true ones, in the worst case.
double worstShare(const DriveParams& found, const DriveParams& truth) {
  const kinematics::Drive one(found), other(truth);
  double worst = 0.0;
  for (const Twist& wanted : {Twist(1.0, 0.0, 0.0), Twist(0.0, 1.0, 0.0), Twist(0.0, 0.0, 4.0)}) {
    const Twist twist = other.nearestPossible(wanted);
    if (twist.norm() < 0.5) continue;
    const auto wheels = one.inverse(twist), true_wheels = other.inverse(twist);
    for (std::size_t i = 0; i < wheels.size(); ++i) {
      const double turns = wheels[i].speed_m_per_s / found.wheels[i].radius_m;
      const double true_turns = true_wheels[i].speed_m_per_s / truth.wheels[i].radius_m;
      worst = std::max(worst, std::abs(turns - true_turns) * truth.wheels[i].radius_m);
    }
  }
  return worst;
}

TEST(WheelCalibration, findsTheGeometryOfEveryDrive) {
  const std::vector<std::pair<std::string, DriveParams>> drives = {
      {"swerve", kinematics::swerveDrive({{0.2, 0.2}, {0.2, -0.2}, {-0.2, 0.2}, {-0.2, -0.2}}, 0.05)},
      {"mecanum", kinematics::mecanumDrive(0.15, 0.12, 0.05)},
      {"omni", kinematics::omniDrive(3, 0.195, 60.0, 0.051)},
      {"differential", kinematics::differentialDrive(0.4, 0.05)},
      {"dead wheels", kinematics::deadWheels(0.5377, 0.2745, 0.0296)}};
  for (const auto& [name, nominal] : drives) {
    const DriveParams truth = worn(nominal);
    const auto found = calibrateWheels(odometryOf(nominal), {driven(truth, 50.0, odometry::twistAt)});
    ASSERT_TRUE(found.usable()) << name << ": " << found.refusal;
    EXPECT_GT(worstShare(nominal, truth), 0.01) << name;
    EXPECT_LT(worstShare(found.params.drive, truth), 0.003) << name;
    EXPECT_LT(found.found.translation_rms_m, 0.5 * found.nominal.translation_rms_m) << name;
    for (std::size_t i = 0; i < truth.wheels.size(); ++i) {
      EXPECT_LT(std::abs(found.params.drive.wheels[i].radius_m - truth.wheels[i].radius_m),
                4.0 * found.sigmas[i].radius_m)
          << name << ' ' << i;
    }
  }
}

TEST(WheelCalibration, theTrackWidthOfADifferentialDriveHasASigma) {
  const DriveParams nominal = kinematics::differentialDrive(0.4, 0.05);
  const DriveParams truth = worn(nominal);
  const auto found = calibrateWheels(odometryOf(nominal), {driven(truth, 60.0, odometry::twistAt)});
  const double true_width_m = truth.wheels[0].y_m - truth.wheels[1].y_m;
  EXPECT_LT(found.track_width_sigma_m, 0.001);
  EXPECT_GT(found.track_width_sigma_m, 1e-6);
  EXPECT_NEAR(found.track_width_m, true_width_m, 4.0 * found.track_width_sigma_m);
}

TEST(WheelCalibration, latenessAndScaleOfTheReferenceAreToldFromTheWheels) {
  const DriveParams nominal = kinematics::omniDrive(3, 0.195, 60.0, 0.051);
  WheelCalibrationParams params;
  params.reference_scale_sigma = 0.01;
  const auto found = calibrateWheels(odometryOf(nominal),
                                     {driven(nominal, 60.0, odometry::twistAt, 0.015, 1.01),
                                      driven(nominal, 60.0, odometry::twistAt, -0.01, 1.01)},
                                     params);
  EXPECT_NEAR(found.time_offsets_s.at(0), 0.015, 0.002);
  EXPECT_NEAR(found.time_offsets_s.at(1), -0.01, 0.002);
  // Lengths alone cannot tell the scale from the radii: both are off within the sigma that is assumed of
  // each.
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GT(found.sigmas[i].radius_m, 0.005 * 0.051);
    EXPECT_LT(std::abs(found.params.drive.wheels[i].radius_m - 0.051), 2.0 * found.sigmas[i].radius_m);
  }
}

TEST(WheelCalibration, slipIsFound) {
  const DriveParams drive = kinematics::omniDrive(3, 0.195, 60.0, 0.051);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  WheelRun run;
  DrivenWheels base(drive);
  constexpr double kSlip_m = 0.004;
  for (int i = 0; i < 6000; ++i) {
    run.samples.push_back(base.sample(false));
    run.reference.push_back({run.samples.back().time_s, inSpace(base.pose())});
    const Twist twist = odometry::twistAt(kPeriod_s * i);
    std::vector<double> slip_m;
    for (const auto& wheel : base.drive().inverse(twist))
      slip_m.push_back(kSlip_m * std::sqrt(std::abs(wheel.speed_m_per_s) * kPeriod_s) * normal(random));
    base.move(twist, kPeriod_s, slip_m);
  }
  const auto found = calibrateWheels(odometryOf(drive), {run});
  EXPECT_NEAR(found.params.slip_sigma_m, kSlip_m, 0.2 * kSlip_m);
}

TEST(WheelCalibration, missingMotionsAreNamed) {
  const DriveParams differential = kinematics::differentialDrive(0.4, 0.05);
  const auto straight = calibrateWheels(
      odometryOf(differential), {driven(differential, 40.0, [](double) { return Twist(0.4, 0.0, 0.0); })});
  EXPECT_FALSE(straight.usable());
  EXPECT_NE(straight.refusal.find("do not determine the position of wheel_1 (left)"), std::string::npos)
      << straight.refusal;
  EXPECT_NE(straight.refusal.find("0.0 turns to the left of 1, 0.0 turns to the right of 1"),
            std::string::npos)
      << straight.refusal;
  EXPECT_NE(straight.refusal.find("UMBmark"), std::string::npos);
  const DriveParams omni = kinematics::omniDrive(3, 0.195, 60.0, 0.051);
  WheelRun elsewhere = driven(omni, 40.0, odometry::twistAt);
  for (auto& pose : elsewhere.reference) pose.time_s += 1e5;
  const auto nothing = calibrateWheels(odometryOf(omni), {elsewhere});
  EXPECT_NE(nothing.refusal.find("only 0 pieces"), std::string::npos) << nothing.refusal;
  EXPECT_NE(missingMotions({10.0, 0.0, 3.0, 3.0}, kinematics::Drive(omni)).find("0.0 m sideways of 2"),
            std::string::npos);
  EXPECT_EQ(missingMotions({10.0, 0.0, 3.0, 3.0}, kinematics::Drive(differential)), "");
}

}  // namespace
}  // namespace stereo_nav::calibration
