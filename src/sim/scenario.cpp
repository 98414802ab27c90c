#include "sim/scenario.h"

#include <cmath>
#include <set>
#include <sstream>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::sim {
namespace {

template <class Item>
std::vector<Item> readList(const YAML::Node& file, const char* key, const std::string& source) {
  std::vector<Item> items;
  const YAML::Node list = file[key];
  if (!list.IsDefined() || list.IsNull()) return items;
  if (!list.IsSequence()) {
    throw ParameterError(source + ": " + key + " must be a list, each item on a line that starts with `- `");
  }
  for (const YAML::Node& node : list) {
    Item item;
    readParameters(node, source + ": " + key + "[" + std::to_string(items.size()) + "]", item);
    items.push_back(item);
  }
  return items;
}

/// Sets `a.b=value` in the tree.
void applyOverride(YAML::Node root, const std::string& text) {
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ParameterError("'" + text + "' is no setting; it must look like timing.time_offset_ms=4");
  }
  std::string path = text.substr(0, equals);
  YAML::Node node;
  node.reset(root);
  for (std::size_t dot; (dot = path.find('.')) != std::string::npos; path = path.substr(dot + 1)) {
    node.reset(YAML::Node(node[path.substr(0, dot)]));
  }
  try {
    node[path] = YAML::Load(text.substr(equals + 1));
  } catch (const YAML::Exception& error) {
    throw ParameterError("the setting '" + text + "' has no value that can be read: " + error.what());
  }
}

void requireOrder(const std::string& source, const std::string& lower, double from, const std::string& upper,
                  double to) {
  if (from < to) return;
  std::ostringstream message;
  message << source << ": " << lower << " is " << from << " and " << upper << " is " << to
          << ": the first must be the smaller one; are they exchanged?";
  throw ParameterError(message.str());
}

}  // namespace

void Event::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "kind", kind,
            {{"light", Kind::kLight},
             {"block_left", Kind::kBlockLeft},
             {"block_right", Kind::kBlockRight},
             {"block_both", Kind::kBlockBoth}},
            "light: the lamps change to `level`; block: something covers the lens");
  visitor.real("from_s", from_s, {0.0, 1e5}, "s", "begin");
  visitor.real("to_s", to_s, {0.0, 1e5}, "s", "end");
  visitor.real("level", level, {0.0, 10.0}, "", "light that is left, 1 is all");
}

void RigParams::describe(ParameterVisitor& visitor) {
  visitor.integer("image_scale", image_scale, {1, 8}, "",
                  "pixels of the calibration are divided into this many in each direction");
  visitor.integer("samples_per_pixel", samples_per_pixel, {1, 16}, "",
                  "rays per pixel, spread over its area and the exposure");
  visitor.real("camera_x_m", camera.x_m, {-5.0, 5.0}, "m", "left camera, forward of base_link");
  visitor.real("camera_y_m", camera.y_m, {-5.0, 5.0}, "m", "left camera, left of base_link");
  visitor.real("camera_z_m", camera.z_m, {0.01, 5.0}, "m", "left camera, above the floor");
  visitor.real("camera_roll_deg", camera.roll_deg, {-360.0, 360.0}, "deg",
               "cameras lean to the right by this");
  visitor.real("camera_pitch_deg", camera.pitch_deg, {-360.0, 360.0}, "deg", "cameras look down by this");
  visitor.real("camera_yaw_deg", camera.yaw_deg, {-360.0, 360.0}, "deg", "cameras look to the left by this");
}

void Scenario::describe(ParameterVisitor& visitor) {
  visitor.integer("world_seed", scene.world_seed, {0, 1000000}, "",
                  "textures and scattered objects; not the seed of a run, the world stays the same");
  visitSection(visitor, "room", scene.room);
  visitSection(visitor, "motion", motion);
  visitSection(visitor, "rig", rig);
  visitSection(visitor, "timing", timing);
  visitSection(visitor, "sensor", sensor);
  visitSection(visitor, "left", left);
  visitSection(visitor, "right", right);
  visitSection(visitor, "imu", imu);
  visitSection(visitor, "wheels", wheels);
}

Scenario loadScenario(const std::string& path, const std::vector<std::string>& overrides) {
  const YAML::Node file = loadYamlFile(path);
  Scenario scenario;
  scenario.path = readList<PathStep>(file, "path", path);
  scenario.events = readList<Event>(file, "events", path);
  scenario.scene.objects = readList<ObjectParams>(file, "objects", path);
  scenario.scene.clutter = readList<ClutterParams>(file, "clutter", path);

  const std::set<std::string> lists{"path", "events", "objects", "clutter"};
  YAML::Node sections(YAML::NodeType::Map);
  for (const auto& entry : file) {
    const auto key = entry.first.as<std::string>();
    if (lists.count(key) == 0) sections[key] = YAML::Clone(entry.second);
  }
  for (const std::string& text : overrides) applyOverride(sections, text);
  readParameters(sections, path, scenario);
  const RoomParams& room = scenario.scene.room;
  requireOrder(path, "room.x_min_m", room.x_min_m, "room.x_max_m", room.x_max_m);
  requireOrder(path, "room.y_min_m", room.y_min_m, "room.y_max_m", room.y_max_m);
  for (std::size_t i = 0; i < scenario.events.size(); ++i) {
    const std::string event = "events[" + std::to_string(i) + "].";
    requireOrder(path, event + "from_s", scenario.events[i].from_s, event + "to_s", scenario.events[i].to_s);
  }
  return scenario;
}

}  // namespace stereo_nav::sim
