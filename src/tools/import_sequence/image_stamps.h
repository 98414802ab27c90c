#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/import_sequence/image_names.h"
#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {

/// Time kStartTime_s + index / rate_hz.
ros::Time stampOfIndex(std::size_t index, double rate_hz);

/// Reads `DIR/left` and `DIR/right` into both tracks of the sequence, with stamps from the first of these
/// that there is:
/// - `DIR/times.txt`: one line a frame, its stamp in seconds (or a date in ms, us or ns), and where the right
///   camera has stamps of its own those in a second column;
/// - the names of the images, where all of them are dates;
/// - `rate_hz`.
/// Pairs are those of equal names. Only where the names are dates of which the cameras share less than half
/// do the images keep their own stamps and are paired by them. What has no partner is left out and listed in
/// a note. Throws InputError.
void readImageFolders(const std::string& folder, std::optional<double> rate_hz, Sequence& sequence);

}  // namespace stereo_nav::tools
