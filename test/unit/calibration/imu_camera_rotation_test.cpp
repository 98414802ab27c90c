#include "calibration/imu_camera_rotation.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "stereo_nav/core/lie.h"

namespace stereo_nav::calibration {
namespace {

constexpr double kTurnDegree = M_PI / 180.0;

/// A rig that is turned by hand: sines about the camera's axes, deg and Hz.
struct Wiggle {
  Eigen::Vector3d amplitude_deg{15.0, 20.0, 12.0};
  Eigen::Vector3d frequency_hz{0.5, 0.37, 0.61};
  double duration_s = 30.0;

  Eigen::Matrix3d orientation(double time_s) const {
    const Eigen::Vector3d angle =
        (kTurnDegree * amplitude_deg)
            .cwiseProduct((2.0 * M_PI * time_s * frequency_hz).array().sin().matrix());
    return expRotation(Eigen::Vector3d(angle.x(), 0, 0)) * expRotation(Eigen::Vector3d(0, angle.y(), 0)) *
           expRotation(Eigen::Vector3d(0, 0, angle.z()));
  }
  /// Angular velocity of the camera in its own frame, rad/s.
  Eigen::Vector3d rate(double time_s) const {
    constexpr double kStep_s = 1e-4;
    return logRotation(orientation(time_s - kStep_s).transpose() * orientation(time_s + kStep_s)) /
           (2.0 * kStep_s);
  }
};

struct Faults {
  double camera_noise_deg = 0.05;  ///< of every orientation
  double gyro_noise_rad_s = 0.01;
  Eigen::Vector3d bias_rad_s{0.02, -0.05, 0.08};
  double imu_offset_s = 0.0;
  double outlier_share = 0.0;  ///< of the orientations
  unsigned seed = 1;
};

const Eigen::Matrix3d kMounting =
    (Eigen::AngleAxisd(2.1, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(-0.4, Eigen::Vector3d::UnitY()) *
     Eigen::AngleAxisd(1.1, Eigen::Vector3d::UnitZ()))
        .toRotationMatrix();  // R_camera_imu

struct Data {
  std::vector<CameraOrientation> camera;
  std::vector<ImuSample> imu;
};

Data simulate(const Wiggle& wiggle, const Faults& faults) {
  std::mt19937 random(faults.seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto noise = [&](double sigma) -> Eigen::Vector3d {
    const double x = normal(random), y = normal(random), z = normal(random);
    return sigma * Eigen::Vector3d(x, y, z);
  };
  Data data;
  for (double t = 0.5; t < wiggle.duration_s; t += 1.0 / 30.0) {
    double sigma_rad = faults.camera_noise_deg * kTurnDegree;
    if (share(random) < faults.outlier_share) sigma_rad = 0.3;
    data.camera.push_back({t, wiggle.orientation(t) * expRotation(noise(sigma_rad)), 0});
  }
  for (double t = 0.0; t < wiggle.duration_s + 1.0; t += 0.01) {
    ImuSample sample;
    sample.time_s = t + faults.imu_offset_s;
    sample.angular_velocity =
        kMounting.transpose() * wiggle.rate(t) + faults.bias_rad_s + noise(faults.gyro_noise_rad_s);
    data.imu.push_back(sample);
  }
  return data;
}

/// The same motion, as a module that sends attitudes reports it.
void useAttitudes(const Wiggle& wiggle, Data& data, double offset_s) {
  for (ImuSample& sample : data.imu) {
    const Eigen::Matrix3d R_world_imu = wiggle.orientation(sample.time_s - offset_s) * kMounting;
    sample.q_world_imu = Eigen::Quaterniond(R_world_imu);
    sample.angular_velocity.reset();
  }
}

Eigen::Vector3d errorOf(const ImuCameraRotation& result) {
  return logRotation(result.R_camera_imu * kMounting.transpose());
}

TEST(ImuCameraRotation, AKnownMountingIsFoundFromRates) {
  const Data data = simulate({}, {});
  const auto result = calibrateImuCameraRotation(data.camera, data.imu);
  ASSERT_TRUE(result.usable()) << result.refusal;
  EXPECT_LT(errorOf(result).norm(), 0.1 * kTurnDegree);
  EXPECT_LT(result.sigma_rad.maxCoeff(), 0.1 * kTurnDegree);
  EXPECT_NEAR(result.imu_offset_s, 0.0, 0.002);
  EXPECT_TRUE(result.bias_rad_s.isApprox(Eigen::Vector3d(0.02, -0.05, 0.08), 0.05)) << result.bias_rad_s;
}

TEST(ImuCameraRotation, AKnownMountingIsFoundFromAttitudes) {
  Data data = simulate({}, {});
  useAttitudes({}, data, 0.0);
  const auto result = calibrateImuCameraRotation(data.camera, data.imu);
  ASSERT_TRUE(result.usable()) << result.refusal;
  EXPECT_LT(errorOf(result).norm(), 0.1 * kTurnDegree);
}

TEST(ImuCameraRotation, LateAndEarlyStampsAreFoundAndDoNoHarm) {
  for (const double offset_s : {-0.2, -0.037, 0.02, 0.15}) {
    Faults faults;
    faults.imu_offset_s = offset_s;
    const Data data = simulate({}, faults);
    const auto result = calibrateImuCameraRotation(data.camera, data.imu);
    ASSERT_TRUE(result.usable()) << result.refusal;
    EXPECT_NEAR(result.imu_offset_s, offset_s, 0.002);
    EXPECT_LT(result.imu_offset_sigma_s, 0.002);
    EXPECT_LT(errorOf(result).norm(), 0.1 * kTurnDegree) << offset_s;
  }
}

TEST(ImuCameraRotation, TheUncertaintyIsHonest) {
  double normalised = 0.0;
  constexpr int kRuns = 40;
  for (int run = 0; run < kRuns; ++run) {
    Faults faults;
    faults.seed = 10 + static_cast<unsigned>(run);
    faults.camera_noise_deg = 0.2;
    const Data data = simulate({}, faults);
    const auto result = calibrateImuCameraRotation(data.camera, data.imu);
    ASSERT_TRUE(result.usable()) << result.refusal;
    normalised += errorOf(result).cwiseQuotient(result.sigma_rad).squaredNorm() / (3.0 * kRuns);
  }
  // Neighbouring turns share an orientation, so that their errors cancel in part and the estimated deviation
  // is somewhat too large.
  EXPECT_LT(normalised, 1.5);
  EXPECT_GT(normalised, 0.2);
}

TEST(ImuCameraRotation, SomeWrongOrientationsDoNoHarm) {
  Faults faults;
  faults.outlier_share = 0.05;
  const Data data = simulate({}, faults);
  const auto result = calibrateImuCameraRotation(data.camera, data.imu);
  ASSERT_TRUE(result.usable()) << result.refusal;
  EXPECT_LT(errorOf(result).norm(), 0.3 * kTurnDegree);
}

TEST(ImuCameraRotation, RunsOfTheVisionAreNotJoined) {
  Data data = simulate({}, {});
  for (std::size_t i = 0; i < data.camera.size(); ++i) {
    data.camera[i].run = static_cast<int>(i / 100);
    // Every run counts from an orientation of its own.
    data.camera[i].R_start_camera =
        expRotation(Eigen::Vector3d(0.3 * data.camera[i].run, 1.0, 0.0)) * data.camera[i].R_start_camera;
  }
  const auto result = calibrateImuCameraRotation(data.camera, data.imu);
  ASSERT_TRUE(result.usable()) << result.refusal;
  EXPECT_LT(errorOf(result).norm(), 0.1 * kTurnDegree);
}

TEST(ImuCameraRotation, TwoAxesAreEnough) {
  Wiggle wiggle;
  wiggle.amplitude_deg.z() = 0.0;
  const Data data = simulate(wiggle, {});
  const auto result = calibrateImuCameraRotation(data.camera, data.imu);
  ASSERT_TRUE(result.usable()) << result.refusal;
  EXPECT_LT(errorOf(result).norm(), 0.2 * kTurnDegree);
}

void expectRefusal(const Data& data, const std::string& part) {
  const auto result = calibrateImuCameraRotation(data.camera, data.imu);
  EXPECT_FALSE(result.usable());
  EXPECT_NE(result.refusal.find(part), std::string::npos) << result.refusal;
}

TEST(ImuCameraRotation, OneAxisIsRefusedAndNamed) {
  Wiggle wiggle;
  wiggle.amplitude_deg = {0.0, 30.0, 0.3};
  expectRefusal(simulate(wiggle, {}), "about the camera's y axis (looking left and right)");
}

TEST(ImuCameraRotation, NoMotionIsRefused) {
  Wiggle wiggle;
  wiggle.amplitude_deg.setConstant(0.1);
  expectRefusal(simulate(wiggle, {}), "hardly turned");
}

TEST(ImuCameraRotation, MirroredAxesAreRefused) {
  Data data = simulate({}, {});
  for (ImuSample& sample : data.imu) sample.angular_velocity->y() *= -1.0;
  expectRefusal(data, "mirrored");
}

TEST(ImuCameraRotation, AnImuThatMovesOnItsOwnIsRefused) {
  Wiggle other;
  other.frequency_hz = {0.8, 0.21, 0.43};
  Data data = simulate({}, {});
  data.imu = simulate(other, {}).imu;
  expectRefusal(data, "disagree");
}

TEST(ImuCameraRotation, PoorDataAreRefused) {
  Data none = simulate({}, {});
  none.imu.clear();
  expectRefusal(none, "no IMU samples");
  Data lost = simulate({}, {});
  lost.camera.resize(50);
  expectRefusal(lost, "the cameras saw only 6 turns");
  expectRefusal({}, "no IMU samples");
  Data other_clock = simulate({}, {});
  for (ImuSample& sample : other_clock.imu) sample.time_s += 1000.0;
  expectRefusal(other_clock, "stamped by one clock");
}

}  // namespace
}  // namespace stereo_nav::calibration
