#pragma once

#include <string>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::nodes {

/// Parameters of send_path.
struct SendPathParams {
  std::string file;
  std::string frame = "map";

  void describe(ParameterVisitor& visitor) {
    visitor.text("file", file, "path as CSV in m, or as the published work's text in mm (docs/driving.md)");
    visitor.text("frame", frame, "frame of its points");
  }
};

}  // namespace stereo_nav::nodes
