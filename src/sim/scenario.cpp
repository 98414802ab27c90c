#include "sim/scenario.h"

#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>

#include "grid/map_file.h"
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

/// A preset is for the sections sensor, left and right: it takes the place of what was set in them before.
void forgetForPreset(YAML::Node sections) {
  for (const char* section : {"sensor", "left", "right"}) sections.remove(section);
}

/// Sets what `source` holds in `target`; maps in both are merged.
void merge(const YAML::Node& source, YAML::Node target) {
  for (const auto& entry : source) {
    const auto key = entry.first.as<std::string>();
    if (entry.second.IsMap() && target[key].IsDefined() && target[key].IsMap()) {
      merge(entry.second, target[key]);
    } else {
      target[key] = YAML::Clone(entry.second);
    }
  }
}

template <class Item>
void append(const YAML::Node& file, const char* key, const std::string& source, std::vector<Item>& items) {
  for (Item& item : readList<Item>(file, key, source)) items.push_back(std::move(item));
}

std::vector<std::string> extendedFiles(const YAML::Node& file, const std::string& source) {
  const YAML::Node extends = file["extends"];
  if (!extends.IsDefined()) return {};
  try {
    if (extends.IsSequence()) return extends.as<std::vector<std::string>>();
    return {extends.as<std::string>()};
  } catch (const YAML::Exception&) {
    throw ParameterError(source +
                         ": extends must be the name of a scenario file beside this one, or a list of them");
  }
}

/// Reads the lists of a file into the scenario and its sections into `sections`, on top of the files that
/// it extends: lists go on, but a path replaces the other one.
void readFile(const std::string& path, int extended_by, Scenario& scenario, const YAML::Node& sections) {
  constexpr int kMostFiles = 10;
  if (extended_by == kMostFiles) {
    throw ParameterError(path + " extends a chain of " + std::to_string(kMostFiles) +
                         " files: does one of them extend itself?");
  }
  const YAML::Node file = loadYamlFile(path);
  for (const std::string& name : extendedFiles(file, path)) {
    const auto base = std::filesystem::path(path).parent_path() / name;
    readFile(base.string(), extended_by + 1, scenario, sections);
  }
  if (file["path"].IsDefined()) scenario.path = readList<PathStep>(file, "path", path);
  append(file, "events", path, scenario.events);
  append(file, "objects", path, scenario.scene.objects);
  append(file, "clutter", path, scenario.scene.clutter);
  const std::set<std::string> others{"extends", "path", "events", "objects", "clutter"};
  YAML::Node own(YAML::NodeType::Map);
  for (const auto& entry : file) {
    const auto key = entry.first.as<std::string>();
    if (others.count(key) == 0) own[key] = entry.second;
  }
  if (own["sensor"].IsDefined() && own["sensor"].IsMap() && own["sensor"]["preset"].IsDefined()) {
    forgetForPreset(sections);
  }
  merge(own, sections);
}

/// The preset gives the values that readParameters() then changes; it also refuses one that does not exist.
void readPreset(const YAML::Node& sections, Scenario& scenario) {
  const YAML::Node sensor = sections["sensor"];
  if (!sensor.IsDefined() || !sensor.IsMap() || !sensor["preset"].IsDefined()) return;
  for (const auto& [name, preset] : sensorPresetNames()) {
    if (name == sensor["preset"].as<std::string>(""))
      applyPreset(preset, scenario.sensor, scenario.left, scenario.right);
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

void requireUsable(const Scenario& scenario, const std::string& path) {
  const RoomParams& room = scenario.scene.room;
  requireOrder(path, "room.x_min_m", room.x_min_m, "room.x_max_m", room.x_max_m);
  requireOrder(path, "room.y_min_m", room.y_min_m, "room.y_max_m", room.y_max_m);
  for (std::size_t i = 0; i < scenario.events.size(); ++i) {
    const std::string event = "events[" + std::to_string(i) + "].";
    requireOrder(path, event + "from_s", scenario.events[i].from_s, event + "to_s", scenario.events[i].to_s);
  }
  if (scenario.sensor.auto_exposure.on && scenario.sensor.full_scale_ms == 0.0) {
    throw ParameterError(
        path +
        ": sensor.auto_exposure.on is true and sensor.full_scale_ms is 0: the brightness would not "
        "depend on the exposure; set full_scale_ms, e.g. to 70");
  }
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
  visitSection(visitor, "map_walls", map_walls);
  visitSection(visitor, "motion", motion);
  visitSection(visitor, "rig", rig);
  visitSection(visitor, "calibration_error", calibration_error);
  visitSection(visitor, "timing", timing);
  visitSection(visitor, "sensor", sensor);
  visitSection(visitor, "left", left);
  visitSection(visitor, "right", right);
  visitSection(visitor, "imu", imu);
  visitSection(visitor, "wheels", wheels);
  visitSection(visitor, "driven", driven);
  visitSection(visitor, "laser", laser);
  visitSection(visitor, "range", range);
}

Scenario loadScenario(const std::string& path, const std::vector<std::string>& overrides) {
  Scenario scenario;
  const YAML::Node sections(YAML::NodeType::Map);
  readFile(path, 0, scenario, sections);
  for (const std::string& text : overrides) {
    if (text.rfind("sensor.preset=", 0) == 0) forgetForPreset(sections);
    applyOverride(sections, text);
  }
  readPreset(sections, scenario);
  readParameters(sections, path, scenario);
  requireUsable(scenario, path);
  if (!scenario.map_walls.file.empty()) {
    const auto map = std::filesystem::path(path).parent_path() / scenario.map_walls.file;
    raiseWalls(grid::loadMap(map.string()), scenario.map_walls, scenario.scene);
  }
  return scenario;
}

}  // namespace stereo_nav::sim
