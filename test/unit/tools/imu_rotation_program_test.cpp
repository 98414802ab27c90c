// The command-line contract of `calibrate_imu_rotation`: simulated recordings of known answer, refusals, and
// a real recording.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/rig_file.h"
#include "stereo_nav/ros/recording.h"
#include "support/command.h"
#include "support/wiggle_bag.h"

namespace stereo_nav::tools {
namespace {

namespace fs = std::filesystem;
constexpr double kDegree = M_PI / 180.0;
constexpr const char* kRig = R"(# A rig.
mounting:   # poses in base_link
  camera: {x_m: 0.1, y_m: 0.06, z_m: 0.283, roll_deg: 0.0, pitch_deg: 5.0, yaw_deg: 0.0}
  imu: {x_m: 0.0, y_m: 0.0, z_m: 0.1, roll_deg: 0.0, pitch_deg: 0.0, yaw_deg: 0.0}  # taped down
)";

std::string contentOf(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class ImuRotationProgramTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = fs::temp_directory_path() / ("imu_rotation_test_" + std::to_string(getpid()));
    fs::create_directories(folder);
  }
  static void TearDownTestSuite() { fs::remove_all(folder); }
  void SetUp() override { std::ofstream(file("rig.yaml")) << kRig; }

  static std::string file(const std::string& name) { return (folder / name).string(); }
  static test::CommandResult calibrate(const std::string& arguments) {
    return test::runCommand(std::string("ROS_PACKAGE_PATH=") + STEREO_NAV_SOURCE_DIR + " " +
                            CALIBRATE_IMU_ROTATION + " " + arguments);
  }

  /// Angle between what the rig file says and the truth.
  static double errorOf(const std::string& rig_file, const Eigen::Matrix3d& R_base_imu) {
    const Eigen::Isometry3d T_base_sensor = RigFile::load(rig_file).mounting().imu.T_base_sensor();
    return Eigen::AngleAxisd(T_base_sensor.linear() * R_base_imu.transpose()).angle() / kDegree;
  }

  static Eigen::Matrix3d cameraRotation() {
    return RigFile::parse(kRig, "rig").mounting().camera.T_base_optical().linear();
  }

  static Eigen::Matrix3d askew() {
    return (Eigen::AngleAxisd(1.7, Eigen::Vector3d::UnitX()) *
            Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY()) *
            Eigen::AngleAxisd(1.4, Eigen::Vector3d::UnitZ()))
        .toRotationMatrix();
  }

  static fs::path folder;
};

fs::path ImuRotationProgramTest::folder;

TEST_F(ImuRotationProgramTest, AKnownMountingIsWrittenIntoTheRigFile) {
  test::Wiggle wiggle;
  wiggle.R_camera_imu = askew();
  wiggle.imu_offset_s = 0.03;
  test::writeWiggleBag(file("wiggle.bag"), wiggle);
  const Eigen::Matrix3d R_base_imu = cameraRotation() * wiggle.R_camera_imu;

  const auto dry = calibrate(file("wiggle.bag") + " --rig " + file("rig.yaml") + " --dry-run");
  ASSERT_EQ(dry.status, 0) << dry.output;
  EXPECT_EQ(contentOf(file("rig.yaml")), kRig);

  const auto result = calibrate(file("wiggle.bag") + " --rig " + file("rig.yaml"));
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_LT(errorOf(file("rig.yaml"), R_base_imu), 0.3) << result.output;
  EXPECT_NE(contentOf(file("rig.yaml")).find("# taped down"), std::string::npos);
  double offset_ms = 0.0;
  const auto at = result.output.find("IMU stamps against the images': ");
  ASSERT_NE(at, std::string::npos) << result.output;
  std::sscanf(result.output.c_str() + at, "IMU stamps against the images': %lf ms", &offset_ms);
  EXPECT_NEAR(offset_ms, 30.0, 4.0) << result.output;
}

TEST_F(ImuRotationProgramTest, AModuleThatSendsAnglesDoesAsWell) {
  test::Wiggle wiggle;
  wiggle.R_camera_imu = askew().transpose();
  wiggle.attitudes = true;
  test::writeWiggleBag(file("angles.bag"), wiggle);
  const auto result = calibrate(file("angles.bag") + " --rig " + file("rig.yaml"));
  ASSERT_EQ(result.status, 0) << result.output;
  EXPECT_LT(errorOf(file("rig.yaml"), cameraRotation() * wiggle.R_camera_imu), 0.3) << result.output;
}

TEST_F(ImuRotationProgramTest, AMotionAboutOneAxisIsRefusedAndNothingIsWritten) {
  test::Wiggle wiggle;
  wiggle.amplitude_deg = {0.0, 15.0, 0.0};
  test::writeWiggleBag(file("yaw.bag"), wiggle);
  const auto result = calibrate(file("yaw.bag") + " --rig " + file("rig.yaml"));
  EXPECT_EQ(result.status, 1) << result.output;
  EXPECT_NE(result.output.find("too few axes"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("looking left and right"), std::string::npos) << result.output;
  EXPECT_EQ(contentOf(file("rig.yaml")), kRig);
}

TEST_F(ImuRotationProgramTest, InputThatCannotBeUsedIsRefused) {
  std::ofstream(file("empty.yaml")) << "cameras: {}\n";
  const auto expectRefusal = [](const std::string& arguments, const std::string& part) {
    const auto result = calibrate(arguments);
    EXPECT_EQ(result.status, 2) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
  };
  expectRefusal("", "BAG and --rig FILE are needed");
  expectRefusal("a.bag --rig " + file("none.yaml"), "none.yaml");
  expectRefusal("a.bag --rig " + file("empty.yaml"), "mounting/camera/roll_deg is missing");
  expectRefusal("a.bag --rig " + file("rig.yaml"), "a.bag");
  expectRefusal("a.bag --frobnicate", "frobnicate");
}

/// A flight of ten seconds (EuRoC MH_01) without deliberate turns.
TEST_F(ImuRotationProgramTest, ARealRecordingGivesItsKnownExtrinsics) {
  const char* data = std::getenv("STEREO_NAV_DATA");
  if (data == nullptr) GTEST_SKIP() << "STEREO_NAV_DATA is not set";
  const auto imported = test::runCommand(std::string(IMPORT_SEQUENCE) + " --format euroc " + data +
                                         "/euroc_mh01_a --output " + file("mh01.bag"));
  ASSERT_EQ(imported.status, 0) << imported.output;
  const auto result = calibrate(file("mh01.bag") + " --rig " + file("rig.yaml"));
  ASSERT_EQ(result.status, 0) << result.output;
  const auto T_imu_camera =
      ros_io::Recording(file("mh01.bag"), {}).transform("base_link", "camera_left_optical");
  ASSERT_TRUE(T_imu_camera);  // base_link is EuRoC's body, the IMU
  const Eigen::Matrix3d R_base_imu = cameraRotation() * T_imu_camera->linear().transpose();
  const double error_deg = errorOf(file("rig.yaml"), R_base_imu);
  std::cout << result.output << "error " << error_deg << " deg\n";
  EXPECT_LT(error_deg, 1.0);
}

}  // namespace
}  // namespace stereo_nav::tools
