#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {

enum class LensModel {
  kPlumbBob,     ///< OpenCV's polynomials: plumb_bob, rational_polynomial, Kalibr's radtan
  kEquidistant,  ///< OpenCV's fisheye model
};

struct RawLens {
  LensModel model = LensModel::kPlumbBob;
  cv::Matx33d K;          ///< px
  std::vector<double> D;  ///< in OpenCV's order
};

/// Geometry of a pair whose images are not rectified.
struct RawPair {
  std::string source;  ///< file that says so, for messages
  cv::Size size;       ///< px; empty: that of the images
  RawLens left;
  RawLens right;
  cv::Matx33d R_right_left;
  cv::Vec3d t_right_left;  ///< m
};

/// Two camera_infos as camera_calibration saves them.
struct RectifyingPair {
  std::string source;
  sensor_msgs::CameraInfo left;
  sensor_msgs::CameraInfo right;
};

/// Calibration of Kalibr (`camchain.yaml`, `*camchain*.yaml`: cam0 is the left camera) or of OpenCV's
/// stereo_calib (`intrinsics.yml` with M1, D1, M2, D2 and `extrinsics.yml` with R, T) in a folder; nothing
/// where there is none. Throws InputError that names the file where it cannot be read or rectified: unknown
/// model, wrong number of coefficients, no rotation, cameras swapped.
std::optional<RawPair> readRawPair(const std::string& folder);

/// `left.yaml` and `right.yaml` of ROS in a folder; nothing where there is none. Throws InputError.
std::optional<RectifyingPair> readRosPair(const std::string& folder);

/// Throws InputError for a pair that cannot be rectified: no rotation, focal lengths, cameras swapped.
void checkRawPair(const RawPair& pair);

/// The rectification of the pair with zero disparity at infinity and no unseen pixel.
RectifyingPair rectifyingPair(const RawPair& pair, const Sequence& sequence);

/// Finds the rectification of the pair and gives it to the sequence, see useRectification(), which judges it.
void useRawPair(const RawPair& pair, Sequence& sequence);

/// Judges both camera_infos (vision::judgePair(), InputError) and gives them to the sequence. Images of
/// lenses that image_proc does not rectify (equidistant, more than eight coefficients, none but a rotation)
/// are rectified while they are read, and the camera_infos are those of the rectified pair.
void useRectification(const RectifyingPair& pair, Sequence& sequence);

}  // namespace stereo_nav::tools
