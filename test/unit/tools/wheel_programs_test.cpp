// The wheels' way from a recording to calibrated odometry: import_sequence, evaluate, calibrate_wheels.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "import_test_support.h"
#include "kinematics/drive_file.h"
#include "kinematics/layouts.h"
#include "support/command.h"
#include "unit/odometry/wheel/driven_wheels.h"

namespace stereo_nav::tools {
namespace {

using kinematics::DriveParams;

constexpr double kCycle_s = 0.04;

class WheelPrograms : public ::testing::Test {
 protected:
  static test::CommandResult run(const std::string& program, const std::string& arguments) {
    return test::runCommand(std::string("ROS_PACKAGE_PATH=") + STEREO_NAV_SOURCE_DIR + " " + program + " " +
                            arguments);
  }

  /// Exit status `status` and one line that holds `part`.
  static void expectRefusal(const std::string& program, const std::string& arguments, int status,
                            const std::string& part) {
    const auto result = run(program, arguments);
    EXPECT_EQ(result.status, status) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
  }

  nlohmann::json evaluate(const std::string& bag, const std::string& rig) const {
    const auto result =
        run(EVALUATE, bag + " --method wheel --rig " + rig + " --output " + (folder_ / "out"));
    EXPECT_EQ(result.status, 0) << result.output;
    std::ifstream file(folder_ / "out/summary.json");
    return nlohmann::json::parse(file);
  }

  void import(const std::string& run_file, const std::string& bag, const std::string& rig = "") const {
    const auto result = run(IMPORT_SEQUENCE, "--format optiodom " + run_file + " --output " + bag +
                                                 (rig.empty() ? "" : " --rig " + rig));
    ASSERT_EQ(result.status, 0) << result.output;
  }

  TemporaryFolder folder_;
};

/// A drive of OptiOdom's robot with wheels that are 2 % smaller, 0 and 1 % larger than its metadata say.
template <class TwistAt>
std::string runOfWornWheels(const DriveParams& nominal, const TwistAt& twist_at) {
  DriveParams truth = nominal;
  truth.wheels[0].radius_m *= 0.98;
  truth.wheels[2].radius_m *= 1.01;
  odometry::DrivenWheels base(truth);
  std::vector<std::int64_t> before(3, 0);
  std::string rows;
  for (int i = 0; i < 1500; ++i) {
    const auto sample = base.sample(false);
    const Eigen::Vector3d pose = {base.pose().translation().x(), base.pose().translation().y(),
                                  Eigen::Rotation2Dd(base.pose().linear()).angle()};
    rows +=
        fmt::format("{},{},{},{},{},{},{}\n", kCycle_s * i, pose.x(), pose.y(), pose.z(),
                    sample.pulses[0] - before[0], sample.pulses[1] - before[1], sample.pulses[2] - before[2]);
    before = sample.pulses;
    base.move(twist_at(kCycle_s * i), kCycle_s);
  }
  return rows;
}

TEST_F(WheelPrograms, aCalibrationMakesTheOdometryRight) {
  const std::string metadata = "type,omni3\nngear,12\nencRes,1024\nLi,0.195\nDi,0.102,0.102,0.102\n";
  folder_.write("a_metadata.csv", metadata);
  folder_.write("a_run-01.csv", "0,0,0,0,0,0,0\n1,0,0,0,0,0,0\n");
  import(folder_ / "a_run-01.csv", folder_ / "a.bag", folder_ / "rig.yaml");
  const DriveParams nominal = kinematics::readDrive(RigFile::load(folder_ / "rig.yaml"));
  folder_.write("a_run-02.csv", runOfWornWheels(nominal, odometry::twistAt));
  import(folder_ / "a_run-02.csv", folder_ / "b.bag");

  const auto before = evaluate(folder_ / "b.bag", folder_ / "rig.yaml");
  const double error_before_m = before["ate_rmse_m"];
  EXPECT_EQ(before["frames"], 1500);
  EXPECT_EQ(before["nees"]["5"]["expected"], 3);
  const auto result = run(CALIBRATE_WHEELS, folder_ / "b.bag" + " --rig " + (folder_ / "rig.yaml"));
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("wheel_1 (front_right)\n  radius         51.0000 -> 49.98"), std::string::npos)
      << result.output;
  const auto after = evaluate(folder_ / "b.bag", folder_ / "rig.yaml");
  EXPECT_LT(after["ate_rmse_m"].get<double>(), 0.1 * error_before_m);
}

TEST_F(WheelPrograms, theSimulatorsWheelsAreCalibratedByItsTruth) {
  folder_.write("rig.yaml", kinematics::driveSection(kinematics::differentialDrive(0.4, 0.05)));
  const std::string bag = folder_ / "square.bag";
  const auto simulated =
      run(SIMULATE, "square --no-images --output " + bag + " --rig " + (folder_ / "rig.yaml") +
                        " --true-rig " + (folder_ / "true.yaml") +
                        " --set wheels.radius_sigma=0.02 --set wheels.position_sigma_m=0.005 --set "
                        "wheels.slip_sigma_m=0.001 --set imu.kind=none");
  ASSERT_EQ(simulated.status, 0) << simulated.output;
  const double nominal = evaluate(bag, folder_ / "rig.yaml")["end_error_percent"];
  const double by_truth = evaluate(bag, folder_ / "true.yaml")["end_error_percent"];
  EXPECT_LT(by_truth, 0.3);
  EXPECT_GT(nominal, by_truth);
  const auto result = run(CALIBRATE_WHEELS, bag + " --rig " + (folder_ / "rig.yaml"));
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(result.output.find("missing motions"), std::string::npos) << result.output;
  const DriveParams truth = kinematics::readDrive(RigFile::load(folder_ / "true.yaml"));
  const DriveParams found = kinematics::readDrive(RigFile::load(folder_ / "rig.yaml"));
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_NEAR(found.wheels[i].radius_m / truth.wheels[i].radius_m, 1.0, 0.002) << i;
  const double true_width_m = truth.wheels[0].y_m - truth.wheels[1].y_m;
  EXPECT_NEAR((found.wheels[0].y_m - found.wheels[1].y_m) / true_width_m, 1.0, 0.005);
}

TEST_F(WheelPrograms, whatCannotBeUsedIsNamed) {
  folder_.write("a_metadata.csv", "type,omni3\nngear,12\nencRes,1024\nLi,0.195\nDi,0.102,0.102,0.102\n");
  folder_.write("a_run-01.csv", "0,0,0,0,0,0,0\n1,0,0,0,0,0,0\n");
  import(folder_ / "a_run-01.csv", folder_ / "a.bag", folder_ / "rig.yaml");
  const DriveParams nominal = kinematics::readDrive(RigFile::load(folder_ / "rig.yaml"));
  folder_.write("a_run-02.csv",
                runOfWornWheels(nominal, [](double) { return kinematics::Twist(0.3, 0.0, 0.0); }));
  import(folder_ / "a_run-02.csv", folder_ / "ahead.bag");
  folder_.write("empty.yaml", "imu: {}\n");
  const std::string bag = folder_ / "a.bag", rig = " --rig " + (folder_ / "rig.yaml");
  expectRefusal(EVALUATE, bag + " --method wheel", 2, "--method wheel needs --rig FILE");
  expectRefusal(EVALUATE, bag + rig, 2, "no topic camera/left/image_raw");
  expectRefusal(EVALUATE, bag + " --method laser", 2, "no topic scan");
  expectRefusal(EVALUATE, bag + " --method sonar", 2, "must be visual, wheel, laser or mono, not 'sonar'");
  expectRefusal(EVALUATE, bag + " --no-prior", 2, "--no-prior is for --method laser");
  expectRefusal(EVALUATE, bag + " --method wheel --segments 5,x" + rig, 2, "--segments must be lengths in m");
  expectRefusal(EVALUATE, bag + " --method wheel --rig " + (folder_ / "empty.yaml"), 2,
                "empty.yaml: drive is missing");
  expectRefusal(EVALUATE, (folder_ / "none.bag") + " --method wheel" + rig, 2, "none.bag: cannot be read");
  expectRefusal(CALIBRATE_WHEELS, bag, 2, "BAG and --rig FILE are needed");
  expectRefusal(CALIBRATE_WHEELS, bag + rig + " --reference vo/odom", 2, "no topic vo/odom with poses");
  expectRefusal(CALIBRATE_WHEELS, bag + rig, 1, "only 0 pieces of 2 s");
  expectRefusal(CALIBRATE_WHEELS, folder_ / "ahead.bag" + rig, 1, "0.0 turns to the left of 1");
  EXPECT_EQ(kinematics::readDrive(RigFile::load(folder_ / "rig.yaml")).wheels[0].radius_m, 0.051)
      << "nothing written";
}

}  // namespace
}  // namespace stereo_nav::tools
