// Size of a map's file and processor time of writing and reading it: keyframes of 500 corners, each described
// at two scales, of which every tenth is a landmark of its own.
//
//   map_file_bench_test [KEYFRAMES]
#include <fmt/format.h>

#include <cstdlib>

#include "core/processor_time.h"
#include "mapping/map/map_file.h"

namespace stereo_nav::mapping {
namespace {

constexpr std::uint64_t kCorners = 500, kScales = 2, kCornersPerLandmark = 10;

VisualMap largeMap(std::uint32_t keyframes) {
  VisualMap map;
  for (std::uint32_t k = 0; k < keyframes; ++k) {
    MapKeyframe in_map;
    in_map.keyframe.id = k;
    in_map.keyframe.follows = k > 0;
    in_map.keyframe.covariance.setIdentity();
    for (std::uint64_t c = 0; c < kCorners; ++c) {
      vision::KeyframeCorner corner;
      corner.landmark_id = 1 + (k * kCorners + c) / kCornersPerLandmark;
      corner.px = Eigen::Vector2d(static_cast<double>(c), 0.3 * k);
      corner.disparity_px = 5.0;
      in_map.keyframe.corners.push_back(corner);
    }
    for (std::uint64_t d = 0; d < kCorners * kScales; ++d)
      in_map.keyframe.descriptors.push_back({d, ~d, k, d * k});
    map.keyframes.push_back(std::move(in_map));
  }
  for (std::uint64_t id = 1; id <= keyframes * kCorners / kCornersPerLandmark; ++id)
    map.landmarks.push_back({id, Eigen::Vector3d::Constant(0.001 * static_cast<double>(id))});
  return map;
}

}  // namespace
}  // namespace stereo_nav::mapping

int main(int argc, char** argv) {
  using namespace stereo_nav;
  const int keyframes = argc > 1 ? std::atoi(argv[1]) : 1000;
  const mapping::VisualMap map = mapping::largeMap(static_cast<std::uint32_t>(keyframes));
  const double start_ms = processorTime_ms();
  const std::string bytes = mapping::toBytes(map);
  const double written_ms = processorTime_ms();
  const mapping::VisualMap again = mapping::mapOfBytes(bytes, "map");
  const double read_ms = processorTime_ms();
  fmt::print("{} keyframes, {} landmarks: {:.1f} MB; {:.0f} ms to write, {:.0f} ms to read\n",
             again.keyframes.size(), again.landmarks.size(), 1e-6 * static_cast<double>(bytes.size()),
             written_ms - start_ms, read_ms - written_ms);
  return 0;
}
