#include "nodes/range_bridge/range_bridge_params.h"

#include <set>

namespace stereo_nav::nodes {
namespace {

constexpr int kMaxFinders = 16;

std::string sectionName(std::size_t index) {
  return "finder_" + std::to_string(index + 1);
}

}  // namespace

void RangeFinderParams::describe(ParameterVisitor& visitor) {
  visitor.text("name", name, "the topic is range/NAME");
  visitor.text("port", port, "serial port, better by its lasting name /dev/serial/by-id/...");
  visitor.text("frame_id", frame_id, "frame of the range finder, which looks along x; empty: range_NAME");
  visitor.real("field_of_view_deg", field_of_view_deg, {0.1, 180.0}, "deg", "angle of the cone that it sees");
  device.describe(visitor);
}

void RangeBridgeParams::describe(ParameterVisitor& visitor) {
  visitor.text("by_id_directory", by_id_directory, "folder of lasting names of serial ports");
  int count = static_cast<int>(finders.size());
  visitor.integer("finders", count, {0, kMaxFinders}, "",
                  "number of range finders; finder_1 to finder_N describe them");
  if (count >= 0 && count <= kMaxFinders) finders.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < finders.size(); ++i) visitSection(visitor, sectionName(i), finders[i]);
}

void RangeBridgeParams::check() const {
  if (finders.empty()) {
    throw ParameterError(
        "range_bridge has no range finders: `finders` is missing or 0; one looks like this:\n"
        "finders: 1\nfinder_1: {name: front, port: /dev/ttyUSB0}");
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < finders.size(); ++i) {
    if (finders[i].name.empty() || finders[i].port.empty()) {
      throw ParameterError(sectionName(i) + " needs `name`, the topic being range/NAME, and `port`");
    }
    if (!names.insert(finders[i].name).second) {
      throw ParameterError(sectionName(i) + ".name is '" + finders[i].name +
                           "', which another one has already; give each its own");
    }
  }
}

}  // namespace stereo_nav::nodes
