#pragma once

#include <string>

#include "mapping/map/visual_map.h"

namespace stereo_nav::mapping {

/// The file of a map, all numbers least significant byte first:
///   "SNAVMAP\n", version (u32), CRC-32 of these twelve bytes (u32),
///   then the sections calibration, keyframes, landmarks, loops, world, each:
///   number of bytes (u64), CRC-32 of the section's name and bytes (u32), the bytes.
/// Corners are stored in single precision, all else as it is. A saved map that is loaded and saved again
/// gives the same bytes.
std::string toBytes(const VisualMap& map);

/// Reads what toBytes() wrote; `path` names it in errors. Throws InputError that names the section for
/// anything that is damaged, cut off, not finite or contradicts itself, and for another version.
VisualMap mapOfBytes(const std::string& bytes, const std::string& path);

/// Writes the file so that it appears only when it is complete. Throws InputError.
void saveMap(const VisualMap& map, const std::string& path);
VisualMap loadMap(const std::string& path);

}  // namespace stereo_nav::mapping
