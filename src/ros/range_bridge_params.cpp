#include "ros/range_bridge_params.h"

#include "core/parameter_list.h"
#include "ros/topic_names.h"

namespace stereo_nav::ros_io {
namespace {

constexpr int kMaxFinders = 16;

}  // namespace

void RangeFinderParams::describe(ParameterVisitor& visitor) {
  visitor.text("name", name, "the topic is range/NAME");
  visitor.text("port", port, "serial port, better by its lasting name /dev/serial/by-id/...");
  visitor.text("frame_id", frame_id, "frame of the range finder, which looks along x; empty: range_NAME");
  visitor.real("field_of_view_deg", field_of_view_deg, {0.1, 180.0}, "deg", "angle of the cone that it sees");
  device.describe(visitor);
  visitSection(visitor, "mounting", mounting);
}

void RangeBridgeParams::describe(ParameterVisitor& visitor) {
  visitor.text("by_id_directory", by_id_directory, "folder of lasting names of serial ports");
  visitList(visitor, "finders", "finder", finders, kMaxFinders, "number of range finders");
}

void RangeBridgeParams::checkNames() const {
  checkTopicNames(finders, "range_finders: the range finder");
}

void RangeBridgeParams::check() const {
  if (finders.empty()) {
    throw ParameterError(
        "range_bridge has no range finders: `finders` is missing or 0; one looks like this:\n"
        "finders: 1\nfinder_1: {name: front, port: /dev/ttyUSB0}");
  }
  checkNames();
  for (const RangeFinderParams& finder : finders) {
    if (finder.port.empty())
      throw ParameterError("range_finders: the range finder " + finder.name +
                           " needs `port`, its serial port");
  }
}

}  // namespace stereo_nav::ros_io
