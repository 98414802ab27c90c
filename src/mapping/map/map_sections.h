#pragma once

#include <functional>
#include <vector>

#include "mapping/map/byte_stream.h"
#include "mapping/map/visual_map.h"

namespace stereo_nav::mapping {

/// A part of a map's file.
struct MapSection {
  const char* name;
  std::function<void(const VisualMap&, ByteWriter&)> write;
  std::function<void(ByteReader&, VisualMap&)> read;  ///< throws InputError
};

/// In the order in which they stand in the file.
const std::vector<MapSection>& mapSections();

}  // namespace stereo_nav::mapping
