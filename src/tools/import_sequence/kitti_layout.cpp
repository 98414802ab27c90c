#include <cmath>
#include <filesystem>

#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/trajectory.h"
#include "stereo_nav/ros/conversions.h"
#include "tools/import_sequence/image_names.h"
#include "tools/import_sequence/rectified_camera.h"
#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {
namespace {

ros::Time toStamp(double time_s) {
  constexpr double kLatest_s = 4e9;  // ros::Time counts in 32 bits
  if (!(time_s >= 0.0 && time_s < kLatest_s)) {
    throw InputError("times.txt: the stamp " + std::to_string(time_s) +
                     " is no time in seconds since the first image; take the file as KITTI gives it");
  }
  ros::Time stamp;
  return stamp.fromNSec(static_cast<std::uint64_t>(std::llround((kStartTime_s + time_s) * 1e9)));
}

/// Row `name:` of calib.txt, a 3x4 projection matrix.
std::vector<double> projection(const std::string& path, const std::string& name) {
  for (const auto& row : readTextTable(path)) {
    if (row.fields[0] != name) continue;
    std::vector<double> values;
    for (std::size_t i = 1; i <= 12; ++i) values.push_back(row.number(i));
    return values;
  }
  throw InputError(path + ": has no line '" + name + "' with a 3x4 projection matrix, as KITTI odometry has");
}

CameraTrack readCamera(const std::string& folder, const std::vector<double>& times_s) {
  CameraTrack camera;
  for (const double time_s : times_s) camera.stamps.push_back(toStamp(time_s));
  camera.frames = readImageFiles(listImages(folder));
  if (camera.frames->size() == times_s.size()) return camera;
  throw InputError(folder + ": holds " + std::to_string(camera.frames->size()) + " images for " +
                   std::to_string(times_s.size()) + " stamps in times.txt; is the folder complete?");
}

RectifiedCamera geometry(const std::vector<double>& P, const cv::Mat& image) {
  return {image.cols, image.rows, P[0], P[5], P[2], P[6], P[3] == 0.0 ? 0.0 : -P[3] / P[0]};
}

/// Both folders must hold images of the same names: that is how KITTI says which belong together.
void checkNames(const std::string& folder) {
  const NamedPairs pairs = pairByName(listImages(folder + "/image_0"), listImages(folder + "/image_1"));
  if (pairs.unpaired.empty()) return;
  throw InputError(folder + ": these images have no partner of the same name in the other camera's folder: " +
                   listOf(pairs.unpaired) + "; copy the missing files, or remove the pair and its lines in " +
                   "times.txt and poses.txt");
}

void checkFolders(const std::string& folder) {
  namespace fs = std::filesystem;
  if (fs::is_directory(folder + "/image_0") && fs::is_directory(folder + "/image_1")) return;
  const bool has_colour = fs::is_directory(folder + "/image_2") && fs::is_directory(folder + "/image_3");
  throw InputError(folder + ": has no folders image_0 and image_1" +
                   (has_colour ? "; image_2 and image_3 are the colour cameras, which are another pair than "
                                 "that of P0, P1 and the poses: download the grey images, too"
                               : ", as KITTI odometry has; the layout of KITTI raw is not supported"));
}

}  // namespace

Sequence readKitti(const std::string& folder) {
  const auto times_s = readKittiTimes(folder + "/times.txt");
  const std::string calibration = folder + "/calib.txt";
  const auto P0 = projection(calibration, "P0:");
  const auto P1 = projection(calibration, "P1:");
  if (P0[3] != 0.0 || P1[3] >= 0.0) {
    throw InputError(calibration +
                     ": P0 must have no offset and P1 must lie to the right of it (P1[3] < 0), they have " +
                     std::to_string(P0[3]) + " and " + std::to_string(P1[3]));
  }
  checkFolders(folder);
  Sequence sequence;
  sequence.left = readCamera(folder + "/image_0", times_s);
  sequence.right = readCamera(folder + "/image_1", times_s);
  checkNames(folder);
  const cv::Mat image = sequence.left.frames->read(0);
  sequence.left.info = toCameraInfo(geometry(P0, image));
  sequence.right.info = toCameraInfo(geometry(P1, image));
  const std::string poses = folder + "/poses.txt";
  if (!std::filesystem::exists(poses)) {
    sequence.notes.push_back("no poses.txt: the recording has no ground truth");
    return sequence;
  }
  for (const auto& pose : stereo_nav::readKitti(poses, times_s)) {
    sequence.ground_truth.push_back({toStamp(pose.time_s), pose.T_world_body});
  }
  return sequence;
}

}  // namespace stereo_nav::tools
