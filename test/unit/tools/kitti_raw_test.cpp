// KITTI raw: a drive of known answer, rectified and not.
#include <cmath>
#include <cstdio>

#include "core/optical_axes.h"
#include "import_test_support.h"
#include "stereo_nav/core/input_error.h"
#include "tools/import_sequence/kitti_raw_files.h"
#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {
namespace {

constexpr double kEquator_m_per_deg = 6378137.0 * M_PI / 180.0;

std::string driveName(bool raw) {
  return std::string("2011_09_26/2011_09_26_drive_0005_") + (raw ? "extract" : "sync");
}

std::string numbered(int index, const char* extension) {
  char name[32];
  std::snprintf(name, sizeof(name), "data/%010d.%s", index, extension);
  return name;
}

std::string dates(int count, double offset_s) {
  std::string text;
  char line[64];
  for (int i = 0; i < count; ++i) {
    std::snprintf(line, sizeof(line), "2011-09-26 13:02:%012.9f\n", 59.85 - 1.0 + 0.1 * i + offset_s);
    text += line;
  }
  return text;
}

/// At the equator, 1 m north a reading, facing north (yaw is counted from east).
std::string oxtsAt(int index) {
  char line[256];
  std::snprintf(line, sizeof(line),
                "%.12f 8.0 110.0 0 0 %.12f 0 10 10 0 0 0.1 0.2 9.8 7 7 7 0.01 0.02 0.03 7 7 7 0 0\n",
                index / kEquator_m_per_deg, M_PI / 2.0);
  return line;
}

/// Camera 1 lies 0.5 m to the right of camera 0, which looks along the unit's x from 0.3 m behind the
/// velodyne, which lies 0.8 m ahead of the unit and 0.4 m above it.
void writeDrive(const TemporaryFolder& folder, bool raw) {
  const std::string drive = driveName(raw) + "/";
  for (int i = 0; i < 5; ++i) {
    writeImage(folder, drive + "image_00/" + numbered(i, "png"), frameOf(i));
    writeImage(folder, drive + "image_01/" + numbered(i, "png"), frameOf(i));
    folder.write(drive + "oxts/" + numbered(i, "txt"), oxtsAt(i));
  }
  folder.write(drive + "image_00/timestamps.txt", dates(5, 0.0));
  folder.write(drive + "image_01/timestamps.txt", dates(5, 0.002));
  folder.write(drive + "oxts/timestamps.txt", dates(5, 0.01));
  std::string calibration =
      "calib_time: 09-Jan-2012 13:57:47\ncorner_dist: 9.95e-02\nR_rect_00: 1 0 0 0 1 0 0 0 1\n";
  for (const char* camera : {"00", "01"}) {
    const std::string name = camera;
    const bool right = name == "01";
    calibration += "S_" + name + ": 64 48\nK_" + name + ": 50 0 31.5 0 50 23.5 0 0 1\nD_" + name +
                   ": -0.01 0 0 0 0\nR_" + name + ": 1 0 0 0 1 0 0 0 1\nT_" + name +
                   (right ? ": -0.5 0 0\n" : ": 0 0 0\n") + "P_rect_" + name + ": 50 0 31.5 " +
                   (right ? "-25" : "0") + " 0 50 23.5 0 0 0 1 0\n";
  }
  folder.write("2011_09_26/calib_cam_to_cam.txt", calibration);
  folder.write("2011_09_26/calib_velo_to_cam.txt",
               "calib_time: x\nR: 0 -1 0 0 0 -1 1 0 0\nT: 0 0 0.3\ndelta_f: 0 0\n");
  folder.write("2011_09_26/calib_imu_to_velo.txt", "calib_time: x\nR: 1 0 0 0 1 0 0 0 1\nT: -0.8 0 -0.4\n");
}

std::string refusalOf(const TemporaryFolder& folder) {
  return messageOf<InputError>([&] { readKittiRaw(folder / driveName(false)); });
}

TEST(KittiRawLayout, ReadsStampsRigPosesAndRates) {
  for (const bool raw : {false, true}) {
    const TemporaryFolder folder;
    writeDrive(folder, raw);
    const Sequence sequence = readKittiRaw(folder / driveName(raw) + "/");
    ASSERT_EQ(sequence.left.stamps.size(), 5u);
    constexpr std::uint64_t kStart_ns = 1317042178850000000;  // 2011-09-26 13:02:58.85 UTC
    EXPECT_EQ(sequence.left.stamps[0].toNSec(), kStart_ns);
    EXPECT_EQ(sequence.right.stamps[4].toNSec(), kStart_ns + 402000000);
    EXPECT_EQ(sequence.left.frames->read(3).at<std::uint8_t>(0, 0), 70);
    EXPECT_NEAR(-sequence.right.info.P[3] / sequence.right.info.P[0], 0.5, 1e-9) << raw;
    EXPECT_NEAR(sequence.left.info.D[0], raw ? -0.01 : 0.0, 1e-12);

    ASSERT_TRUE(sequence.T_body_camera);
    EXPECT_TRUE(sequence.T_body_camera->linear().isApprox(opticalToBody(), 1e-9));
    EXPECT_TRUE(sequence.T_body_camera->translation().isApprox(Eigen::Vector3d(0.5, 0.0, 0.4), 1e-9))
        << sequence.T_body_camera->translation().transpose();
    ASSERT_EQ(sequence.imu.readings.size(), 5u);
    EXPECT_EQ(sequence.imu.readings[1].stamp.toNSec(), kStart_ns + 110000000);
    EXPECT_TRUE(sequence.imu.readings[0].angular_velocity.isApprox(Eigen::Vector3d(0.01, 0.02, 0.03)));
    EXPECT_TRUE(sequence.imu.readings[0].linear_acceleration.isApprox(Eigen::Vector3d(0.1, 0.2, 9.8)));
    ASSERT_EQ(sequence.ground_truth.size(), 5u);
    const Eigen::Isometry3d T_world_body =
        sequence.ground_truth[4].T_world_camera * sequence.T_body_camera->inverse();
    EXPECT_TRUE(T_world_body.translation().isApprox(Eigen::Vector3d(0.0, 4.0, 0.0), 1e-6))
        << T_world_body.translation().transpose();
    EXPECT_TRUE((T_world_body.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-9));
    EXPECT_TRUE(sequence.notes.empty());
    EXPECT_TRUE(readKittiRaw(folder / driveName(raw), false).imu.readings.empty());
  }
}

TEST(KittiRawLayout, MercatorScaleIsThatOfTheFirstLatitude) {
  const TemporaryFolder folder;
  folder.write("timestamps.txt", dates(2, 0.0));
  folder.write(numbered(0, "txt"),
               "60 8 100 0 0 0" + std::string(24, ' ') + "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n");
  folder.write(numbered(1, "txt"), "60 8.001 101 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\n");
  std::size_t left_out = 0;
  const auto readings = readOxts(folder.path(), left_out);
  ASSERT_EQ(readings.size(), 2u);
  // A degree of longitude at 60 degrees is half as long as at the equator.
  EXPECT_NEAR(readings[1].T_world_imu.translation().x(), 0.0005 * kEquator_m_per_deg, 1e-6);
  EXPECT_NEAR(readings[1].T_world_imu.translation().y(), 0.0, 1e-6);
  EXPECT_NEAR(readings[1].T_world_imu.translation().z(), 1.0, 1e-9);
}

TEST(KittiRawLayout, WhatIsMissingIsLeftOutAndSaid) {
  const TemporaryFolder folder;
  writeDrive(folder, false);
  const std::string drive = driveName(false) + "/";
  std::filesystem::remove(folder / (drive + "image_01/" + numbered(2, "png")));
  std::filesystem::remove(folder / (drive + "oxts/" + numbered(1, "txt")));
  const Sequence sequence = readKittiRaw(folder / driveName(false));
  ASSERT_EQ(sequence.right.stamps.size(), 4u);
  EXPECT_NEAR((sequence.right.stamps[2] - sequence.left.stamps[3]).toSec(), 0.002, 1e-9);
  EXPECT_EQ(sequence.ground_truth.size(), 4u);
  ASSERT_EQ(sequence.notes.size(), 1u);
  EXPECT_NE(sequence.notes[0].find("not later than the one before are left out: 1"), std::string::npos);

  std::filesystem::remove_all(folder / (drive + "oxts"));
  const Sequence blind = readKittiRaw(folder / driveName(false));
  EXPECT_TRUE(blind.ground_truth.empty());
  EXPECT_TRUE(blind.T_body_camera->linear().isApprox(opticalToBody()));
}

TEST(KittiRawLayout, NamesWhatItCannotUse) {
  const TemporaryFolder folder;
  writeDrive(folder, false);
  const std::string drive = driveName(false) + "/";
  folder.write(drive + "image_00/timestamps.txt", "yesterday\n");
  EXPECT_NE(refusalOf(folder).find("timestamps.txt:1: 'yesterday ' is no date"), std::string::npos)
      << refusalOf(folder);
  folder.write(drive + "image_00/timestamps.txt", dates(4, 0.0));
  EXPECT_NE(refusalOf(folder).find("0000000004.png: the name is no line of timestamps.txt, which has 4"),
            std::string::npos);
  folder.write(drive + "image_00/timestamps.txt", dates(5, 0.0));
  folder.write("2011_09_26/calib_velo_to_cam.txt", "R: 0 0 0 0 0 0 0 0 0\nT: 0 0 0\n");
  EXPECT_NE(refusalOf(folder).find("R is no rotation matrix"), std::string::npos);
  folder.write("2011_09_26/calib_cam_to_cam.txt", "S_00: 64 48\n");
  EXPECT_NE(refusalOf(folder).find("has no line 'P_rect_00:' with 12 numbers"), std::string::npos);
  std::filesystem::remove(folder / "2011_09_26/calib_cam_to_cam.txt");
  EXPECT_NE(refusalOf(folder).find("unpack the calibration of the drive's day"), std::string::npos);
  std::filesystem::remove_all(folder / (drive + "image_00"));
  EXPECT_NE(refusalOf(folder).find("give the drive's folder"), std::string::npos);
}

}  // namespace
}  // namespace stereo_nav::tools
