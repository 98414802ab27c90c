#pragma once

#include <string>
#include <vector>

#include "sensors/range/range_device.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::nodes {

/// One range finder. Those of the device are among them, without a section.
struct RangeFinderParams {
  std::string name;
  std::string port;
  std::string frame_id;
  double field_of_view_deg = 3.6;
  range::RangeDeviceParams device;

  void describe(ParameterVisitor& visitor);
};

/// Parameters of the range_bridge node: `finders`, how many there are, and for each a section `finder_1`,
/// `finder_2` ...
struct RangeBridgeParams {
  std::string by_id_directory = "/dev/serial/by-id";
  std::vector<RangeFinderParams> finders;

  void describe(ParameterVisitor& visitor);
  /// Throws ParameterError where there is no finder, or one without port or a name of its own.
  void check() const;
};

}  // namespace stereo_nav::nodes
