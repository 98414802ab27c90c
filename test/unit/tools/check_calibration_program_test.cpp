// The command-line contract of `check_calibration`: simulated boards of known pose, refusals, and the real
// pairs of OpenCV's documentation.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/rig_file.h"
#include "stereo_nav/calibration/board_pose.h"
#include "support/command.h"
#include "support/simulated_board.h"
#include "support/stereo_webcams.h"

namespace stereo_nav::tools {
namespace {

namespace fs = std::filesystem;
using calibration::Checkerboard;

class CheckCalibrationTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder = fs::temp_directory_path() / ("check_calibration_test_" + std::to_string(getpid()));
    fs::create_directories(folder / "good");
    const test::WebcamPair cameras = test::webcamPair(640);
    const test::SimulatedBoard scene(cameras.left, cameras.right, Checkerboard{});
    int number = 0;
    for (const Eigen::Isometry3d& pose : poses()) {
      const auto pair = scene.draw(pose, static_cast<std::uint64_t>(++number));
      cv::imwrite(file("good/left0" + std::to_string(number) + ".png"), pair.left);
      cv::imwrite(file("good/right0" + std::to_string(number) + ".png"), pair.right);
    }
    writeRig("good", test::toRig(cameras.left, cameras.right));
  }
  static void TearDownTestSuite() { fs::remove_all(folder); }

  static std::vector<Eigen::Isometry3d> poses() {
    return {test::boardAt(-0.15, -0.12, 1.1, 20, 10, 0), test::boardAt(0.25, -0.12, 1.1, -20, 15, 3),
            test::boardAt(-0.15, 0.14, 1.1, 25, -20, -4), test::boardAt(0.25, 0.14, 1.1, -10, -25, 0),
            test::boardAt(0.03, 0.0, 0.8, 5, 5, 10)};
  }
  static std::string file(const std::string& name) { return (folder / name).string(); }
  static void writeRig(const std::string& name, const calibration::StereoRig& rig) {
    fs::create_directories(folder / name);
    test::writeCalibration(file(name + "/left.yaml"), "left", rig.left);
    test::writeCalibration(file(name + "/right.yaml"), "right", rig.right);
  }
  static test::CommandResult check(const std::string& arguments) {
    return test::runCommand(std::string(CHECK_CALIBRATION) + " " + arguments);
  }
  static nlohmann::json report(const std::string& name) {
    std::ifstream stream(file(name));
    return nlohmann::json::parse(stream);
  }
  /// Exit status 2 and one last line that holds `part`.
  static void expectRefusal(const std::string& arguments, const std::string& part) {
    const auto result = check(arguments);
    EXPECT_EQ(result.status, 2) << result.output;
    EXPECT_NE(result.output.find("check_calibration: "), std::string::npos) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
  }

  static fs::path folder;
};

fs::path CheckCalibrationTest::folder;

TEST_F(CheckCalibrationTest, WhatItFindsOfTheUncertaintyGoesIntoTheRigFile) {
  std::ofstream(file("rig.yaml")) << "mounting:  # as measured\n  camera: {x_m: 0.1}\n";
  const auto result = check(file("good") + " --rig " + file("rig.yaml") + " --json " + file("sigmas.json"));
  ASSERT_EQ(result.status, 0) << result.output;
  const RigFile rig = RigFile::load(file("rig.yaml"));
  EXPECT_EQ(rig.text().rfind("mounting:  # as measured\n  camera: {x_m: 0.1}\n", 0), 0u) << rig.text();
  const YAML::Node section = rig.section(rig_sections::kUncertainty);
  const auto json = report("sigmas.json")["uncertainty"];
  ASSERT_EQ(section.size(), 4u) << rig.text();
  for (const auto& entry : section)
    EXPECT_NEAR(entry.second.as<double>(), json[entry.first.as<std::string>()].get<double>(), 1e-5);
  EXPECT_LT(section["baseline_sigma_share"].as<double>(), 0.005);
  EXPECT_LT(section["distortion_sigma_px"].as<double>(), 0.1);
}

TEST_F(CheckCalibrationTest, AGoodCalibrationIsGoodAndTheBoardIsWhereItIs) {
  const auto result = check(file("good") + " --size 8x6 --square 0.051 --json " + file("good.json"));
  ASSERT_EQ(result.status, 0) << result.output;
  const auto json = report("good.json");
  EXPECT_EQ(json["verdict"], "good");
  EXPECT_NEAR(json["baseline_m"].get<double>(), 0.12, 0.0001);
  EXPECT_NEAR(json["field_of_view_deg"]["left"][0].get<double>(), 62.0, 3.0);
  const double f = json["focal_length_px"].get<double>(), noise_px = json["disparity_noise_px"].get<double>();
  const double at_10m = json["depth_deviation_m"][9]["deviation_m"].get<double>();
  EXPECT_NEAR(at_10m, 100.0 * noise_px / (f * json["baseline_m"].get<double>()), 1e-9);
  ASSERT_EQ(json["views"].size(), poses().size());
  for (std::size_t i = 0; i < poses().size(); ++i) {
    const auto& view = json["views"][i];
    const Eigen::Vector3d seen(view["position_m"][0], view["position_m"][1], view["position_m"][2]);
    EXPECT_LT((seen - poses()[i].translation()).norm(), 0.0029) << view["name"];
    const auto angles = calibration::boardAngles(poses()[i].linear());
    EXPECT_NEAR(view["yaw_deg"].get<double>(), angles.yaw_rad * 180 / M_PI, 0.3) << view["name"];
    EXPECT_NEAR(view["pitch_deg"].get<double>(), angles.pitch_rad * 180 / M_PI, 0.3) << view["name"];
  }
}

TEST_F(CheckCalibrationTest, TwoFoldersAndACalibrationElsewhereAreTaken) {
  for (const std::string side : {"left", "right"}) {
    fs::create_directories(folder / "apart" / side);
    for (const std::string number : {"01", "02"}) {
      fs::copy_file(file("good/" + side + number + ".png"), file("apart/" + side + "/" + number + ".png"));
    }
  }
  const auto result = check(file("apart") + " --calibration " + file("good"));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_NE(result.output.find("2 of 2 pairs"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("note: only 2 views"), std::string::npos) << result.output;
}

TEST_F(CheckCalibrationTest, AKnockedCameraIsPoorAndTheRemedyIsNamed) {
  const test::WebcamPair cameras = test::webcamPair(640);
  auto rig = test::toRig(cameras.left, cameras.right);
  rig.right.R = cv::Matx33d(1, 0, 0, 0, 1, -0.004, 0, 0.004, 1) * rig.right.R;
  writeRig("knocked", rig);
  const auto result =
      check(file("good") + " --calibration " + file("knocked") + " --json " + file("poor.json"));
  EXPECT_EQ(result.status, 1) << result.output;
  EXPECT_NE(result.output.find("the cameras have moved since the calibration"), std::string::npos)
      << result.output;
  EXPECT_EQ(report("poor.json")["verdict"], "poor");
}

TEST_F(CheckCalibrationTest, InputThatCannotBeUsedIsRefused) {
  fs::create_directories(folder / "empty");
  expectRefusal(file("empty"), "left.yaml: does not exist");
  expectRefusal(file("empty") + " --calibration " + file("good"), "no pair of images");
  fs::create_directories(folder / "one");
  for (const std::string side : {"left", "right"}) {
    fs::copy_file(file("good/" + side + "01.png"), file("one/" + side + "01.png"));
  }
  expectRefusal(file("one") + " --size 9x6 --calibration " + file("good"),
                "is in none of 1 pairs: check --size");
  expectRefusal(file("good") + " --size 8by6", "--size is '8by6'");
  expectRefusal(file("good") + " --square 51", "--square is in metres");
  expectRefusal(file("nothing.bag"), "nothing.bag");
  expectRefusal(file("good") + " --frobnicate", "frobnicate");
  std::ofstream(file("empty/left.yaml")) << "nonsense";
  std::ofstream(file("empty/right.yaml")) << "nonsense";
  expectRefusal(file("good") + " --calibration " + file("empty"), "cannot be read as a camera calibration");
  const test::WebcamPair small = test::webcamPair(320);
  writeRig("small", test::toRig(small.left, small.right));
  expectRefusal(file("good") + " --calibration " + file("small"), "calibrate at the size that is used");
  const test::WebcamPair cameras = test::webcamPair(640);
  auto swapped = test::toRig(cameras.left, cameras.right);
  std::swap(swapped.left, swapped.right);
  writeRig("swapped", swapped);
  expectRefusal(file("good") + " --calibration " + file("swapped"), "Are left and right swapped?");
}

/// Thirteen pairs that come with OpenCV, and what came with them: the lens of the left camera and the poses
/// of the board as somebody else's program found them (left_intrinsics.yml).
TEST_F(CheckCalibrationTest, RealPairsAgreeWithOpenCvsOwnFigures) {
  const fs::path data = "/usr/share/doc/opencv-doc/examples/data";
  if (!fs::exists(data / "left01.jpg")) GTEST_SKIP() << data << ": opencv-doc is not installed";
  const Checkerboard board{9, 6, 0.025};
  std::vector<calibration::BoardCorners> views;
  fs::create_directories(folder / "opencv");
  for (const std::string number :
       {"01", "02", "03", "04", "05", "06", "07", "08", "09", "11", "12", "13", "14"}) {
    for (const std::string side : {"left", "right"}) {
      fs::create_symlink(data / (side + number + ".jpg"), folder / "opencv" / (side + number + ".jpg"));
    }
    const auto grey = [&](const std::string& name) {
      return cv::imread(file("opencv/" + name), cv::IMREAD_GRAYSCALE);
    };
    const auto corners =
        calibration::findCorners(grey("left" + number + ".jpg"), grey("right" + number + ".jpg"), board);
    ASSERT_TRUE(corners) << number;
    views.push_back(*corners);
  }
  double opencv_rms_px = 0.0;
  const auto rig = test::calibrateByOpenCv(views, board, cv::Size(640, 480), &opencv_rms_px);
  writeRig("opencv", rig);

  const auto result = check(file("opencv") + " --size 9x6 --square 0.025 --json " + file("opencv.json"));
  std::cout << result.output;
  ASSERT_EQ(result.status, 0) << result.output;
  const auto json = report("opencv.json");
  ASSERT_EQ(json["views"].size(), 13u);
  EXPECT_EQ(json["verdict"], "good");
  EXPECT_LT(opencv_rms_px, 0.25);
  std::map<std::string, double> found;
  for (const auto& criterion : json["criteria"]) found[criterion["name"]] = criterion["value"];
  EXPECT_NEAR(found["reprojection"], opencv_rms_px, 0.03);
  EXPECT_LT(found["epipolar"], 0.3);
  EXPECT_LT(std::abs(found["scale"]), 0.3);

  const cv::FileStorage shipped((data / "left_intrinsics.yml").string(), cv::FileStorage::READ);
  cv::Mat K, extrinsics;
  shipped["camera_matrix"] >> K;
  shipped["extrinsic_parameters"] >> extrinsics;
  EXPECT_NEAR(rig.left.K(0, 0), K.at<double>(0, 0), 0.01 * K.at<double>(0, 0));
  for (int i = 0; i < extrinsics.rows; ++i) {
    cv::Matx33d R;
    cv::Rodrigues(cv::Vec3d(extrinsics.ptr<double>(i)), R);
    // From their first corner to the middle of the board.
    const cv::Vec3d middle = R * cv::Vec3d(0.1, 0.0625, 0.0) + cv::Vec3d(extrinsics.ptr<double>(i) + 3);
    const double distance_m = json["views"][static_cast<std::size_t>(i)]["distance_m"].get<double>();
    EXPECT_NEAR(distance_m, cv::norm(middle), 0.003) << i;  // their focal length is 0.5 % longer
  }
}

}  // namespace
}  // namespace stereo_nav::tools
