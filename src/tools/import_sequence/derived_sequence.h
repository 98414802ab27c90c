#pragma once

#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {

/// The same recording with time running backwards: what was last comes first. Stamps keep their distances and
/// begin where they began; angular rates change sign, accelerations do not.
void reverse(Sequence& sequence);

/// The same recording seen in a mirror: images flipped left to right, the left camera taking the right one's
/// place and the other way round. Calibration, body, IMU and ground truth are reflected at the plane x = 0 of
/// their own frames, so that all remains consistent.
void mirror(Sequence& sequence);

}  // namespace stereo_nav::tools
