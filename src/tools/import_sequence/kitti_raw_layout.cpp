// A drive of KITTI raw, rectified (sync) or not (extract).
#include <algorithm>
#include <filesystem>

#include "core/optical_axes.h"
#include "stereo_nav/core/input_error.h"
#include "tools/import_sequence/image_names.h"
#include "tools/import_sequence/kitti_raw_files.h"
#include "tools/import_sequence/raw_pair.h"
#include "tools/import_sequence/rectified_camera.h"
#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {
namespace {

namespace fs = std::filesystem;

/// "00" for image_00.
struct CameraNames {
  std::string left, right;
};

CameraNames chooseCameras(const std::string& drive, Sequence& sequence) {
  const auto holds = [&](const char* camera) {
    return fs::is_directory(drive + "/image_" + camera + "/data");
  };
  if (holds("00") && holds("01")) return {"00", "01"};
  if (holds("02") && holds("03")) {
    sequence.notes.push_back("no grey cameras (image_00, image_01): the colour cameras are taken");
    return {"02", "03"};
  }
  throw InputError(
      drive +
      ": holds neither image_00/data and image_01/data nor image_02/data and image_03/data; give "
      "the drive's folder, e.g. 2011_09_26/2011_09_26_drive_0005_sync");
}

CameraTrack readDriveCamera(const std::string& folder) {
  const auto dates = readDates(folder + "/timestamps.txt");
  CameraTrack camera;
  std::vector<std::string> paths = listImages(folder + "/data");
  for (const std::string& path : paths) {
    const std::string name = fs::path(path).stem().string();
    const bool number = name.size() < 12 &&
                        std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
    const std::size_t index = number ? std::stoull(name) : dates.size();
    if (index >= dates.size()) {
      throw InputError(path + ": the name is no line of timestamps.txt, which has " +
                       std::to_string(dates.size()) + "; copy the drive again");
    }
    if (!camera.stamps.empty() && dates[index] <= camera.stamps.back()) {
      throw InputError(folder + "/timestamps.txt:" + std::to_string(index + 1) +
                       ": the stamp is not later than the one before");
    }
    camera.stamps.push_back(dates[index]);
  }
  camera.frames = readImageFiles(std::move(paths));
  return camera;
}

/// Motion from the raw camera 0 to a raw camera.
Eigen::Isometry3d fromCamera0(const std::string& calibration, const std::string& camera) {
  const auto R = calibrationRow(calibration, "R_" + camera, 9);
  const auto t = calibrationRow(calibration, "T_" + camera, 3);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.data());
  motion.translation() = Eigen::Vector3d(t[0], t[1], t[2]);
  return motion;
}

RawLens readLens(const std::string& calibration, const std::string& camera) {
  RawLens lens;
  lens.K = cv::Matx33d(calibrationRow(calibration, "K_" + camera, 9).data());
  lens.D = calibrationRow(calibration, "D_" + camera, 5);
  return lens;
}

/// Gives the camera_infos of raw images. Returns the motion from the raw camera 0 to the rectified left one.
Eigen::Isometry3d useRawImages(const std::string& calibration, const CameraNames& names, Sequence& sequence) {
  RawPair pair;
  pair.source = calibration;
  pair.left = readLens(calibration, names.left);
  pair.right = readLens(calibration, names.right);
  const auto size = calibrationRow(calibration, "S_" + names.left, 2);
  pair.size = cv::Size(static_cast<int>(size[0]), static_cast<int>(size[1]));
  const Eigen::Isometry3d T_left_0 = fromCamera0(calibration, names.left);
  const Eigen::Isometry3d T_right_left = fromCamera0(calibration, names.right) * T_left_0.inverse();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      pair.R_right_left(row, column) = T_right_left.linear()(row, column);
    pair.t_right_left[row] = T_right_left.translation()[row];
  }
  checkRawPair(pair);
  const RectifyingPair rectifying = rectifyingPair(pair, sequence);
  useRectification(rectifying, sequence);
  const Eigen::Matrix3d R_rectified_left =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rectifying.left.R.data());
  return Eigen::Isometry3d(R_rectified_left) * T_left_0;
}

/// The same for rectified images.
Eigen::Isometry3d useRectifiedImages(const std::string& calibration, const CameraNames& names,
                                     Sequence& sequence) {
  const auto left = calibrationRow(calibration, "P_rect_" + names.left, 12);
  const auto right = calibrationRow(calibration, "P_rect_" + names.right, 12);
  const double baseline_m = (left[3] - right[3]) / left[0];
  if (!(baseline_m > 0.0)) {
    throw InputError(calibration + ": camera " + names.right + " does not lie to the right of camera " +
                     names.left + " (P_rect); copy the calibration of the drive's day again");
  }
  const cv::Mat image = sequence.left.frames->read(0);
  sequence.left.info = toCameraInfo({image.cols, image.rows, left[0], left[5], left[2], left[6], 0.0});
  sequence.right.info =
      toCameraInfo({image.cols, image.rows, right[0], right[5], right[2], right[6], baseline_m});
  const auto R = calibrationRow(calibration, "R_rect_00", 9);
  Eigen::Isometry3d T_left_0 = Eigen::Isometry3d::Identity();
  T_left_0.linear() = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(R.data());
  T_left_0.translation().x() = left[3] / left[0];
  return T_left_0;
}

void useOxts(const std::string& drive, bool with_imu, Sequence& sequence) {
  std::size_t left_out = 0;
  const auto readings = readOxts(drive + "/oxts", left_out);
  for (const OxtsReading& reading : readings) {
    sequence.ground_truth.push_back({reading.stamp, reading.T_world_imu * *sequence.T_body_camera});
    if (with_imu) {
      sequence.imu.readings.push_back({reading.stamp, reading.angular_velocity, reading.linear_acceleration});
    }
  }
  if (left_out > 0) {
    sequence.notes.push_back(
        "oxts: readings that are missing or not later than the one before are left out: " +
        std::to_string(left_out));
  }
}

}  // namespace

Sequence readKittiRaw(const std::string& folder, bool with_imu) {
  const fs::path drive =
      (fs::absolute(folder) / "").lexically_normal().parent_path();  // without a slash at its end
  const std::string day = drive.parent_path().string();
  const std::string calibration = day + "/calib_cam_to_cam.txt";
  Sequence sequence;
  const CameraNames names = chooseCameras(drive.string(), sequence);
  if (!fs::exists(calibration)) {
    throw InputError(calibration +
                     ": does not exist; unpack the calibration of the drive's day (YYYY_MM_DD_calib.zip) "
                     "beside the drive's folder");
  }
  sequence.left = readDriveCamera(drive.string() + "/image_" + names.left);
  sequence.right = readDriveCamera(drive.string() + "/image_" + names.right);
  const std::string name = drive.filename().string();
  const bool raw = name.size() >= 7 && name.compare(name.size() - 7, 7, "extract") == 0;
  const Eigen::Isometry3d T_left_0 =
      raw ? useRawImages(calibration, names, sequence) : useRectifiedImages(calibration, names, sequence);
  if (!fs::is_directory(drive / "oxts")) {
    sequence.T_body_camera = Eigen::Isometry3d(opticalToBody());
    sequence.notes.push_back("no oxts: the recording has neither ground truth nor IMU");
    return sequence;
  }
  const Eigen::Isometry3d T_left_imu =
      T_left_0 * readMotion(day + "/calib_velo_to_cam.txt") * readMotion(day + "/calib_imu_to_velo.txt");
  sequence.T_body_camera = T_left_imu.inverse();
  useOxts(drive.string(), with_imu, sequence);
  return sequence;
}

}  // namespace stereo_nav::tools
