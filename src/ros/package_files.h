#pragma once

#include <string>

namespace stereo_nav::ros_io {

/// Returns `name` itself where such a file exists, otherwise the file of that name in the package's config
/// folder. Throws an InputError that names both places.
std::string configFile(const std::string& name);

/// Returns `name` itself where such a file exists, otherwise the scenario of that name in the package.
std::string scenarioFile(const std::string& name);

/// Folder of the thesis rig's left.yaml and right.yaml.
std::string thesisCalibrationFolder();

}  // namespace stereo_nav::ros_io
