// Prints and exports what a map's file holds, and sets where it lies in the world.
#include <cstdio>
#include <filesystem>

#include "core/atomic_file.h"
#include "mapping/map/g2o_file.h"
#include "mapping/map/map_file.h"
#include "stereo_nav/core/input_error.h"
#include "tools/common/program.h"
#include "tools/map_info/map_export.h"
#include "tools/map_info/map_info_options.h"

namespace stereo_nav::tools {
namespace {

Similarity exportFrame(const MapInfoOptions& options, const mapping::VisualMap& map) {
  if (!options.in_world) return {};
  if (!map.world)
    throw InputError(options.file +
                     ": --in-world, but the map is not set in the world; use --set-world first");
  return map.world->T_world_map;
}

int run(int argc, char** argv) {
  const auto options = parseMapInfoOptions(argc, argv);
  if (!options) return 0;
  mapping::VisualMap map = mapping::loadMap(options->file);
  if (!options->world_pairs.empty()) {
    map.world = mapping::alignWithWorld(mapping::readWorldPairs(options->world_pairs), options->freedom);
    mapping::saveMap(map, options->save);
  }
  std::printf("%s: %ju bytes\n%s", options->file.c_str(),
              std::uintmax_t{std::filesystem::file_size(options->file)}, describe(map).c_str());
  const Similarity frame = exportFrame(*options, map);
  if (!options->tum.empty()) writeFileAtomically(options->tum, toTum(keyframePoses(map, frame)));
  if (!options->ply.empty()) writeFileAtomically(options->ply, toPly(map, frame));
  if (!options->g2o.empty()) writeFileAtomically(options->g2o, mapping::toG2o(mapping::graphOf(map)));
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("map_info", stereo_nav::tools::run, argc, argv);
}
