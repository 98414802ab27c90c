// Calibrations of pairs that are not rectified.
#include <cmath>
#include <filesystem>

#include "import_test_support.h"
#include "stereo_nav/core/input_error.h"
#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {
namespace {

/// Kalibr's file: the right camera 0.1 m (or `baseline_m`) to the right.
std::string kalibr(const std::string& model, const std::string& coefficients, double baseline_m = 0.1) {
  const std::string camera = "  camera_model: pinhole\n  distortion_model: " + model +
                             "\n  distortion_coeffs: " + coefficients +
                             "\n  intrinsics: [40, 40, 31.5, 23.5]\n  resolution: [64, 48]\n";
  return "cam0:\n" + camera + "cam1:\n" + camera + "  T_cn_cnm1:\n  - [1, 0, 0, " +
         std::to_string(-baseline_m) + "]\n  - [0, 1, 0, 0]\n  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n";
}

/// A camera_info file of camera_calibration; its camera is turned by `angle_rad` about y.
std::string rosInfo(const std::string& model, const std::string& coefficients, int count, double angle_rad,
                    double Tx) {
  const std::string c = std::to_string(std::cos(angle_rad)), s = std::to_string(std::sin(angle_rad));
  return "image_width: 64\nimage_height: 48\ncamera_name: test\n"
         "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [40, 0, 31.5, 0, 40, 23.5, 0, 0, 1]\n"
         "distortion_model: " +
         model + "\ndistortion_coefficients:\n  rows: 1\n  cols: " + std::to_string(count) +
         "\n  data: " + coefficients + "\nrectification_matrix:\n  rows: 3\n  cols: 3\n  data: [" + c +
         ", 0, " + s + ", 0, 1, 0, -" + s + ", 0, " + c +
         "]\nprojection_matrix:\n  rows: 3\n  cols: 4\n  data: [40, 0, 31.5, " + std::to_string(Tx) +
         ", 0, 40, 23.5, 0, 0, 0, 1, 0]\n";
}

class RawPairs : public ::testing::Test {
 protected:
  /// Pairs of 64x48 whose grey value is four times the column.
  RawPairs() {
    cv::Mat image(kHeight, kWidth, CV_8UC1);
    for (int x = 0; x < kWidth; ++x) image.col(x).setTo(4 * x);
    for (const char* side : {"left/0.png", "right/0.png"}) writeImage(folder_, side, image);
  }

  std::string refusal() {
    return messageOf<InputError>([&] { readImages(folder_.path()); });
  }

  TemporaryFolder folder_;
};

TEST_F(RawPairs, kalibrRadtanIsRectifiedDownstream) {
  folder_.write("camchain.yaml", kalibr("radtan", "[-0.1, 0.01, 0.001, 0.002]"));
  const Sequence sequence = readImages(folder_.path());
  EXPECT_EQ(sequence.left.info.distortion_model, "plumb_bob");
  EXPECT_EQ(sequence.left.info.D, (std::vector<double>{-0.1, 0.01, 0.001, 0.002}));
  EXPECT_NEAR(-sequence.right.info.P[3] / sequence.right.info.P[0], 0.1, 1e-9);
  EXPECT_EQ(sequence.left.frames->read(0).at<std::uint8_t>(5, 10), 40);
}

TEST_F(RawPairs, equidistantIsRectifiedWhileItIsImported) {
  folder_.write("camchain.yaml", kalibr("equidistant", "[0, 0, 0, 0]"));
  const Sequence sequence = readImages(folder_.path());
  const sensor_msgs::CameraInfo& info = sequence.left.info;
  EXPECT_EQ(info.distortion_model, "plumb_bob");
  EXPECT_EQ(info.D, std::vector<double>(5, 0.0));
  EXPECT_NEAR(-sequence.right.info.P[3] / sequence.right.info.P[0], 0.1, 1e-9);
  // The lens maps an angle to 40 px a radian, the rectified image its tangent to P[0].
  const cv::Mat image = sequence.left.frames->read(0);
  for (const int x : {20, 31, 45, 60}) {
    const double raw_x = 31.5 + 40.0 * std::atan((x - info.P[2]) / info.P[0]);
    ASSERT_TRUE(raw_x > 1.0 && raw_x < kWidth - 2) << raw_x;
    EXPECT_NEAR(image.at<std::uint8_t>(24, x), 4.0 * raw_x, 1.5) << x;
  }
  EXPECT_NE(sequence.notes.back().find("rectified while they are imported"), std::string::npos);
}

TEST_F(RawPairs, rosCalibrationsAreTakenOver) {
  folder_.write("left.yaml", rosInfo("rational_polynomial", "[0.1, 0, 0, 0, 0, 0.05, 0, 0]", 8, 0.0, 0.0));
  folder_.write("right.yaml", rosInfo("rational_polynomial", "[0.1, 0, 0, 0, 0, 0.05, 0, 0]", 8, 0.01, -4.0));
  const Sequence sequence = readImages(folder_.path());
  EXPECT_EQ(sequence.right.info.distortion_model, "rational_polynomial");
  EXPECT_EQ(sequence.right.info.D.size(), 8u);
  EXPECT_NEAR(sequence.right.info.R[2], 0.01, 1e-5);
  EXPECT_EQ(sequence.right.info.P[3], -4.0);
}

TEST_F(RawPairs, aRotationWithoutDistortionIsRectifiedWhileItIsImported) {
  folder_.write("left.yaml", rosInfo("plumb_bob", "[0, 0, 0, 0, 0]", 5, 0.0, 0.0));
  folder_.write("right.yaml", rosInfo("plumb_bob", "[0, 0, 0, 0, 0]", 5, 0.1, -4.0));
  const Sequence sequence = readImages(folder_.path());
  EXPECT_EQ(sequence.right.info.R[2], 0.0);
  EXPECT_EQ(sequence.left.frames->read(0).at<std::uint8_t>(24, 30), 120);
  // A ray of the rectified camera is turned back by 0.1 rad: x_raw = tan(angle - 0.1).
  EXPECT_NEAR(sequence.right.frames->read(0).at<std::uint8_t>(24, 31),
              4.0 * (31.5 + 40.0 * std::tan(std::atan(-0.5 / 40.0) - 0.1)), 2.0);
}

TEST_F(RawPairs, openCvFilesAreRead) {
  const auto matrix = [](const std::string& name, int rows, int cols, const std::string& data) {
    return name + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
           "\n   cols: " + std::to_string(cols) + "\n   dt: d\n   data: [ " + data + " ]\n";
  };
  const std::string K = "40., 0., 31.5, 0., 40., 23.5, 0., 0., 1.";
  const std::string D = "-0.1, 0.01, 0., 0., 0.";
  folder_.write("intrinsics.yml", "%YAML:1.0\n---\n" + matrix("M1", 3, 3, K) + matrix("D1", 1, 5, D) +
                                      matrix("M2", 3, 3, K) + matrix("D2", 1, 5, D));
  EXPECT_NE(refusal().find("extrinsics.yml: does not exist"), std::string::npos);
  const auto extrinsics = [&](const std::string& T) {
    folder_.write(
        "extrinsics.yml",
        "%YAML:1.0\n---\n" + matrix("R", 3, 3, "1., 0., 0., 0., 1., 0., 0., 0., 1.") + matrix("T", 3, 1, T));
  };
  extrinsics("-0.2, 0., 0.");
  const Sequence sequence = readImages(folder_.path());
  EXPECT_NEAR(-sequence.right.info.P[3] / sequence.right.info.P[0], 0.2, 1e-9);
  EXPECT_EQ(sequence.left.info.width, 64u);
  extrinsics("-200., 0., 0.");
  EXPECT_NE(refusal().find("was the size of the board's squares given in metres?"), std::string::npos);
  extrinsics("0.2, 0., 0.");
  EXPECT_NE(refusal().find("are the two swapped?"), std::string::npos);
}

TEST_F(RawPairs, refusesWhatItCannotUse) {
  folder_.write("camchain.yaml", kalibr("fov", "[0.9]"));
  EXPECT_NE(refusal().find("'pinhole-fov' is not supported"), std::string::npos);
  folder_.write("camchain.yaml", kalibr("radtan", "[0, 0, 0]"));
  EXPECT_NE(refusal().find("distortion_coeffs must be 4"), std::string::npos);
  folder_.write("camchain.yaml", "cam0: 1\ncam1: 2\n");
  EXPECT_NE(refusal().find("is not as Kalibr writes it"), std::string::npos);
  folder_.write("camchain.yaml", kalibr("radtan", "[0.1, 0, 0, 0]"));
  folder_.write("calib.txt", kImagesCalibration);
  EXPECT_NE(refusal().find("holds more than one calibration"), std::string::npos);
  std::filesystem::remove(folder_ / "calib.txt");
  std::filesystem::remove(folder_ / "camchain.yaml");
  folder_.write("left.yaml", rosInfo("plumb_bob", "[0.1, 0, 0, 0, 0, 0, 0, 0]", 8, 0.0, 0.0));
  EXPECT_NE(refusal().find("right.yaml: does not exist"), std::string::npos);
  folder_.write("right.yaml", rosInfo("plumb_bob", "[0, 0, 0, 0, 0]", 5, 0.0, -4.0));
  EXPECT_NE(refusal().find("D holds 8 coefficients, plumb_bob has 5"), std::string::npos);
  const std::string fisheye = rosInfo("plumb_bob", "[0.1, 0, 0, 0]", 4, 0.0, 0.0) + "camera_model: fisheye\n";
  folder_.write("left.yaml", fisheye);
  EXPECT_NE(refusal().find("camera_model 'fisheye' with distortion_model 'plumb_bob' is not supported"),
            std::string::npos);
}

// Findings of scripts/fuzz.sh: ROS's reader ended the process, OpenCV's message named no file.
TEST_F(RawPairs, refusesMatricesOfAnotherSizeThanTheySay) {
  folder_.write("right.yaml", rosInfo("plumb_bob", "[0, 0, 0, 0, 0]", 5, 0.0, -4.0));
  folder_.write("left.yaml", rosInfo("plumb_bob", "[0.1, 0, 0, 0]", 5, 0.0, 0.0));
  EXPECT_NE(refusal().find("left.yaml: distortion_coefficients has not as many numbers as its rows and cols"),
            std::string::npos);
  std::filesystem::remove(folder_ / "left.yaml");
  std::filesystem::remove(folder_ / "right.yaml");
  folder_.write(
      "intrinsics.yml",
      "%YAML:1.0\n---\nM1: !!opencv-matrix\n   rows: -3\n   cols: 3\n   dt: d\n   data: [1., 2.]\n");
  folder_.write("extrinsics.yml", "%YAML:1.0\n---\nR: 0\n");
  EXPECT_NE(refusal().find("intrinsics.yml: M1 is missing or has not the size"), std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::tools
