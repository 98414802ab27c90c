#pragma once

#include <string>

#include "core/rig_file.h"
#include "kinematics/drive_params.h"

namespace stereo_nav::kinematics {

/// The wheels of the robot: section `drive` of its rig file. Throws ParameterError, with a message that
/// begins with the file's name, where the section or a value that nobody can guess (radius_m,
/// pulses_per_turn) is missing, for unknown names and values out of range, for two wheels of one name, and
/// where the wheels leave a motion of the base undetermined.
DriveParams readDrive(const RigFile& rig);

/// Writes contact point, direction and radius of each wheel into the section `drive`, which must have these
/// wheels; every other byte of the file stays as it is.
void writeDrive(const DriveParams& drive, RigFile& rig);

/// The section `drive` as text.
std::string driveSection(const DriveParams& drive);

}  // namespace stereo_nav::kinematics
