#pragma once

#include <string>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::nodes {

/// Parameters of the map_image_server node.
struct MapImageServerParams {
  std::string map;
  std::string frame_id = "map";

  void describe(ParameterVisitor& visitor) {
    visitor.text("map", map, "path of the YAML file of a map, in map_server's format");
    visitor.text("frame_id", frame_id, "frame of the map");
  }
};

}  // namespace stereo_nav::nodes
