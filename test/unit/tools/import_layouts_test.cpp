#include <opencv2/videoio.hpp>

#include "import_test_support.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/trajectory.h"
#include "stereo_nav/ros/conversions.h"
#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {
namespace {

template <class Read>
std::string errorOf(Read read, const TemporaryFolder& folder) {
  return messageOf<std::runtime_error>([&] { read(folder.path()); });
}

Sequence euroc(const std::string& folder) {
  return readEuroc(folder);
}

TEST(EurocLayout, readsCamerasImuAndGroundTruth) {
  const TemporaryFolder folder;
  writeEuroc(folder);
  const Sequence sequence = readEuroc(folder.path());
  ASSERT_EQ(sequence.left.stamps.size(), 6u);
  EXPECT_EQ(sequence.right.stamps[5].toNSec(), static_cast<std::uint64_t>(kEurocStart_ns + 250000000));
  EXPECT_EQ(sequence.left.frames->read(3).at<std::uint8_t>(0, 0), 70);
  EXPECT_NEAR(-sequence.right.info.P[3] / sequence.right.info.P[0], 0.1, 1e-12);
  ASSERT_EQ(sequence.imu.readings.size(), 5u);
  EXPECT_TRUE(sequence.imu.readings[4].linear_acceleration.isApprox(Eigen::Vector3d(1, 2, 9.8)));
  EXPECT_NEAR(sequence.imu.angular_velocity_variance, 0.01 * 0.01 * 100.0, 1e-12);
  ASSERT_EQ(sequence.ground_truth.size(), 3u);
  EXPECT_TRUE(sequence.ground_truth[1].T_world_camera.translation().isApprox(Eigen::Vector3d(5, 6, 3), 1e-9));
  EXPECT_TRUE(sequence.notes.empty());
}

TEST(EurocLayout, theCameraFrameIsTheRectifiedOne) {
  // Cameras that are both turned by 0.1 rad about y while their baseline stays along x of the body:
  // rectification turns both back, and the camera's frame with them.
  const TemporaryFolder folder;
  writeEuroc(folder);
  const std::string rows =
      "T_BS:\n  data: [0.995004165, 0, 0.099833417, %, 0, 1, 0, 0, -0.099833417, 0, 0.995004165, 0, 0, 0, 0, "
      "1]\n";
  for (const auto& [camera, x] : {std::pair("cam0", "0.0"), std::pair("cam1", "0.1")}) {
    std::string text = eurocCamera(0.0);
    text = rows + text.substr(text.find("resolution"));
    folder.write(std::string(camera) + "/sensor.yaml", text.replace(text.find('%'), 1, x));
  }
  const Sequence sequence = readEuroc(folder.path());
  EXPECT_TRUE(sequence.T_body_camera->linear().isApprox(Eigen::Matrix3d::Identity(), 1e-6));
  EXPECT_NEAR(sequence.left.info.R[2], 0.0998334, 1e-6);
}

TEST(EurocLayout, findsTheFoldersBelowMav0AndDoesWithoutImu) {
  const TemporaryFolder folder;
  writeEuroc(folder);
  std::filesystem::create_directories(folder / "zip/mav0");
  for (const char* camera : {"cam0", "cam1"}) {
    std::filesystem::rename(folder / camera, folder / ("zip/mav0/" + std::string(camera)));
  }
  const Sequence sequence = readEuroc(folder / "zip");
  EXPECT_EQ(sequence.left.frames->size(), 6u);
  EXPECT_TRUE(sequence.imu.readings.empty());
  EXPECT_TRUE(sequence.ground_truth.empty());
  EXPECT_EQ(sequence.notes.size(), 2u);
}

/// A finding of scripts/fuzz.sh: ROS's message named no file.
TEST(EurocLayout, refusesStampsThatNoTimeHolds) {
  const TemporaryFolder folder;
  writeEuroc(folder);
  folder.write("cam0/data.csv", "9223372036854775807,a.png\n");
  EXPECT_NE(errorOf(euroc, folder).find("is no date in nanoseconds"), std::string::npos);
}

TEST(EurocLayout, namesWhatItCannotUse) {
  const TemporaryFolder folder;
  EXPECT_NE(errorOf(euroc, folder).find("cam0: does not exist"), std::string::npos);
  writeEuroc(folder);
  folder.write("cam1/sensor.yaml", eurocCamera(-0.1));
  EXPECT_NE(errorOf(euroc, folder).find("are the two swapped?"), std::string::npos);
  folder.write("cam1/sensor.yaml", "distortion_model: equidistant\n");
  EXPECT_NE(errorOf(euroc, folder).find("only radial-tangential is supported"), std::string::npos);
  folder.write("cam1/sensor.yaml", "distortion_model: radial-tangential\nresolution: [64]\n");
  EXPECT_NE(errorOf(euroc, folder).find("resolution has 1 values"), std::string::npos);
  folder.write("cam1/sensor.yaml", "distortion_model: radial-tangential\n");
  EXPECT_NE(errorOf(euroc, folder).find("resolution is missing"), std::string::npos);
  folder.write("cam1/sensor.yaml", eurocCamera(0.1));
  folder.write("imu0/data.csv", "1403636584000000000,nan,0,0,0,0,0\n");
  EXPECT_NE(errorOf(euroc, folder).find("data.csv:1: 'nan' is not a finite number"), std::string::npos);
  folder.write("cam0/data.csv", "5,a.png\n5,b.png\n");
  EXPECT_NE(errorOf(euroc, folder).find("data.csv:2: the stamp 5 is not later"), std::string::npos);
}

TEST(EurocLayout, anImuFolderWithoutDataNamesTheOption) {
  const TemporaryFolder folder;
  writeEuroc(folder);
  folder.write("imu0/data.csv", "#timestamp [ns]\n");
  EXPECT_NE(errorOf(euroc, folder).find("--no-imu"), std::string::npos);
  std::filesystem::remove_all(folder / "imu0");
  std::filesystem::create_directories(folder / "imu0");
  EXPECT_NE(errorOf(euroc, folder).find("--no-imu"), std::string::npos);
  EXPECT_EQ(readEuroc(folder.path(), false).left.frames->size(), 6u);
}

TEST(KittiLayout, imagesAreInTheOrderOfTheirNumbersAndHaveEqualNames) {
  const TemporaryFolder folder;
  writeKitti(folder);
  for (const char* camera : {"image_0/", "image_1/"}) {
    std::filesystem::remove_all(folder / camera);
    for (int i = 8; i < 12; ++i) writeImage(folder, camera + std::to_string(i) + ".png", frameOf(i));
  }
  const Sequence sequence = readKitti(folder.path());
  EXPECT_EQ(sequence.left.frames->read(1).at<std::uint8_t>(0, 0), 190);
  EXPECT_EQ(sequence.left.frames->read(2).at<std::uint8_t>(0, 0), 210);
  std::filesystem::rename(folder / "image_1/11.png", folder / "image_1/7.png");
  const std::string message = errorOf(readKitti, folder);
  EXPECT_NE(message.find("image_1/7.png, image_0/11.png"), std::string::npos) << message;
}

TEST(KittiLayout, namesTheColourFolders) {
  const TemporaryFolder folder;
  writeKitti(folder);
  std::filesystem::rename(folder / "image_0", folder / "image_2");
  std::filesystem::rename(folder / "image_1", folder / "image_3");
  EXPECT_NE(errorOf(readKitti, folder).find("image_2 and image_3 are the colour cameras"), std::string::npos);
}

TEST(KittiLayout, readsPosesAndProjection) {
  const TemporaryFolder folder;
  writeKitti(folder);
  const Sequence sequence = readKitti(folder.path());
  ASSERT_EQ(sequence.left.stamps.size(), 4u);
  EXPECT_EQ(sequence.left.stamps[1], ros::Time(1000, 100000000));
  EXPECT_EQ(sequence.left.info.width, 64u);
  EXPECT_DOUBLE_EQ(sequence.right.info.P[3], -25.0);
  EXPECT_EQ(sequence.left.info.P[3], 0.0);
  ASSERT_EQ(sequence.ground_truth.size(), 4u);
  EXPECT_FALSE(sequence.T_body_camera);
}

TEST(KittiLayout, namesWhatItCannotUse) {
  const TemporaryFolder folder;
  EXPECT_NE(errorOf(readKitti, folder).find("times.txt: cannot be read"), std::string::npos);
  writeKitti(folder);
  std::filesystem::remove(folder / "image_1/000003.png");
  EXPECT_NE(errorOf(readKitti, folder).find("image_1: holds 3 images for 4 stamps"), std::string::npos);
  folder.write("calib.txt", "P0: 50 0 31.5 0 0 50 23.5 0 0 0 1 0\n");
  EXPECT_NE(errorOf(readKitti, folder).find("no line 'P1:'"), std::string::npos);
}

TEST(ImagesLayout, readsFolders) {
  const TemporaryFolder folder;
  for (int i = 0; i < 3; ++i) {
    writeImage(folder, "left/" + std::to_string(i) + ".png", frameOf(i));
    writeImage(folder, "right/" + std::to_string(i) + ".png", frameOf(i));
  }
  EXPECT_NE(errorOf(readImages, folder).find("calib.txt: does not exist"), std::string::npos);
  folder.write("calib.txt", kImagesCalibration);
  const Sequence at_default_rate = readImages(folder.path());
  EXPECT_EQ(at_default_rate.left.stamps[2], ros::Time(1000, 200000000));
  EXPECT_EQ(at_default_rate.notes.size(), 1u);
  EXPECT_NEAR(at_default_rate.right.info.P[3], -50 * 0.09, 1e-12);
  EXPECT_EQ(at_default_rate.right.info.P[5], 51.0);

  folder.write("calib.txt", std::string(kImagesCalibration) + "fps 4\n");
  EXPECT_EQ(readImages(folder.path()).left.stamps[1], ros::Time(1000, 250000000));
  folder.write("calib.txt", "fx 50\nfy 51\n");
  EXPECT_NE(errorOf(readImages, folder).find("has no line 'cx'"), std::string::npos);
  folder.write("calib.txt", "fx -50\n");
  EXPECT_NE(errorOf(readImages, folder).find("must be above 0"), std::string::npos);
}

TEST(ImagesLayout, readsVideos) {
  const TemporaryFolder folder;
  folder.write("calib.txt", kImagesCalibration);
  EXPECT_NE(errorOf(readImages, folder).find("no video *L.mp4"), std::string::npos);
  for (const char* name : {"rigL.avi", "rigR.avi"}) {
    cv::VideoWriter video(folder / name, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 5.0, {kWidth, kHeight});
    cv::Mat colour;
    for (int i = 0; i < 4; ++i) {
      cv::merge(std::vector<cv::Mat>(3, frameOf(i)), colour);
      video.write(colour);
    }
  }
  const Sequence sequence = readImages(folder.path());
  ASSERT_EQ(sequence.left.frames->size(), 4u);
  EXPECT_EQ(sequence.left.stamps[1], ros::Time(1000, 200000000));
  EXPECT_EQ(sequence.left.frames->read(2).type(), CV_8UC3);
  // Forward over a gap, and back again.
  EXPECT_NEAR(sequence.left.frames->read(3).at<cv::Vec3b>(20, 20)[1], 70, 6);
  EXPECT_NEAR(sequence.left.frames->read(1).at<cv::Vec3b>(20, 20)[1], 30, 6);

  folder.write("broken_left.avi", "no video");
  EXPECT_NE(errorOf(readImages, folder).find("more than one video"), std::string::npos);
}

TEST(FrameReader, refusesWhatItWouldMisread) {
  const TemporaryFolder folder;
  writeImage(folder, "alpha.png", cv::Mat(kHeight, kWidth, CV_8UC4, cv::Scalar::all(100)));
  folder.write("truncated.png", "\x89PNG\r\n");
  const auto messageFor = [&folder](const std::string& name) {
    return messageOf<InputError>([&] { readImageFiles({folder / name})->read(0); });
  };
  EXPECT_NE(messageFor("alpha.png").find("CV_8UC4 are not supported"), std::string::npos);
  EXPECT_NE(messageFor("truncated.png").find("is damaged"), std::string::npos);
  EXPECT_NE(messageFor("absent.png").find("does not exist"), std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::tools
