#pragma once

#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {

/// Lets 16-bit images use their full range, as mono16 means it: finds from images spread over the recording
/// how many bits the cameras fill and in which byte order, scales both cameras alike and adds a note.
/// Recordings of 8 bits stay as they are.
void useFullRange(Sequence& sequence);

}  // namespace stereo_nav::tools
