#pragma once

#include <string>

#include "vision/camera_fields.h"

namespace stereo_nav::vision {

/// Refuses what cannot be one camera's calibration (InputError): NaN, all zero, no size, K, R or P with
/// entries that mean something else, focal length or principal point that do not fit the image.
void checkMatrices(const std::string& name, const CameraFields& camera);

/// Works binning and roi into K, P and the size. Throws InputError where they do not fit the image.
void applyWindow(const std::string& name, CameraFields& camera);

}  // namespace stereo_nav::vision
