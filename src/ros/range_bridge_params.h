#pragma once

#include <string>
#include <vector>

#include "core/rig_file.h"
#include "sensors/range/range_device.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::ros_io {

/// One range finder: range/NAME. Those of the device are among them, without a section.
struct RangeFinderParams {
  std::string name;
  std::string port;
  std::string frame_id;  ///< empty: range_NAME
  double field_of_view_deg = 3.6;
  range::RangeDeviceParams device;
  SensorMounting mounting;

  std::string frame() const { return frame_id.empty() ? "range_" + name : frame_id; }
  void describe(ParameterVisitor& visitor);
};

/// Parameters of the range_bridge node: section `range_finders` of the rig file, with `finders`, how many
/// there are, and for each a section `finder_1`, `finder_2` ...
struct RangeBridgeParams {
  std::string by_id_directory = "/dev/serial/by-id";
  std::vector<RangeFinderParams> finders;

  void describe(ParameterVisitor& visitor);
  /// Throws ParameterError where two finders share a name, or one has a name that no topic can have.
  void checkNames() const;
  /// The same, and where there is no finder or one has no port.
  void check() const;
};

}  // namespace stereo_nav::ros_io
