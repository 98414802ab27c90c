#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stereo_nav::ros_io {

/// Namespaces, without slashes at their ends, below which a recording has images or camera_infos of a stereo
/// rig.
std::vector<std::string> rigNamespaces(const std::vector<std::string>& topics);

/// The namespace of the rig to use: `wanted`, or the only one there is; empty where there is none. Throws
/// InputError that lists the rigs, and what each lacks, when there are several and none is wanted, or when
/// the wanted one is not among them.
std::string chooseRig(const std::vector<std::string>& topics, const std::optional<std::string>& wanted);

}  // namespace stereo_nav::ros_io
