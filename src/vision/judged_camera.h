#pragma once

#include <string>
#include <vector>

#include "vision/camera_fields.h"

namespace stereo_nav::vision {

/// Judges one camera's calibration before it is used: matrices, lens model, window. `name` begins the
/// messages, what was assumed is added to `notes`. Throws InputError.
CameraFields judgeCamera(const std::string& name, CameraFields camera, std::vector<std::string>& notes);

/// Has the image rectified where all coefficients are 0 although R and P move pixels: image_proc would copy
/// it.
void keepFromBeingCopied(const std::string& name, CameraFields& camera, std::vector<std::string>& notes);

}  // namespace stereo_nav::vision
