#pragma once

#include <string>
#include <vector>

#include "stereo_nav/vision/stereo_calibration.h"
#include "vision/camera_fields.h"

namespace stereo_nav::vision {

/// A stereo calibration with which OpenCV and image_geometry do what it says.
struct JudgedPair {
  CameraFields left;   ///< of the images as they are delivered: without binning and roi
  CameraFields right;  ///< the same of the right camera
  StereoCalibration calibration;
  std::vector<std::string> notes;  ///< what was assumed or changed, one line each
};

/// Judges a calibration before it is used; everything that rectifies takes the result. Two things are
/// changed:
///   - binning and roi are worked into the matrices, and the size becomes that of the delivered images;
///   - where all coefficients are 0 but R or P move pixels, the first one becomes negligible instead.
///     image_geometry and image_proc copy the images unrectified where all are 0.
/// Throws InputError that names the field and the remedy for everything that image_geometry would end the
/// process on, or that cannot be a stereo calibration: NaN, no calibration, an unknown lens model or another
/// number of coefficients, R no rotation, P with other entries than focal lengths, principal point and
/// baseline, a baseline outside 2 cm to 2 m (with the likely unit), a focal length that does not fit the
/// image, a principal point outside of it, a roi or binning that does not fit the image, cameras swapped, two
/// calibrations that are not of one pair.
JudgedPair judgePair(const CameraFields& left, const CameraFields& right);

}  // namespace stereo_nav::vision
