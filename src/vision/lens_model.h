#pragma once

#include <string>
#include <vector>

#include "vision/camera_fields.h"

namespace stereo_nav::vision {

/// Whether a coefficient differs from 0.
bool bends(const CameraFields& camera);

/// Whether the raw image is the rectified one already: no pixel moves by a thousandth of its width.
bool isRectified(const CameraFields& camera);

/// For each pixel of the rectified image where it lies in the raw one, px, CV_32FC1.
struct RawPixels {
  cv::Mat columns;
  cv::Mat rows;
};

/// The raw pixels of the rectified image; empty for a lens model, or a number of coefficients, that OpenCV
/// does not know. Binning and roi are not looked at.
RawPixels rawPixels(const CameraFields& camera);

/// Brings model and coefficients into a form that OpenCV and image_geometry take: a supported model with the
/// number of coefficients that belongs to it. A model without a name, or with one that says that there is
/// nothing to correct, is taken for that of a rectified image, if it is one. Throws InputError that names the
/// model and the way out; `name` begins the message, what was assumed is added to `notes`.
void normaliseLens(const std::string& name, CameraFields& camera, std::vector<std::string>& notes);

}  // namespace stereo_nav::vision
