#include "mapping/map/map_sections.h"

namespace stereo_nav::mapping {
namespace {

constexpr std::size_t kDescriptorBytes = 32, kCornerBytes = 8 + 4 * 4;
constexpr std::size_t kKeyframeBytes = 4 + 8 + 1 + 2 * 96 + 288 + 8 + 1;
constexpr std::size_t kLandmarkBytes = 8 + 24, kLoopBytes = 2 * 4 + 96 + 288 + 1;

void writeCalibration(const VisualMap& map, ByteWriter& writer) {
  writer.integer(map.calibration_hash);
}

void readCalibration(ByteReader& reader, VisualMap& map) {
  map.calibration_hash = reader.integer<std::uint64_t>();
}

void writeKeyframe(const MapKeyframe& in_map, ByteWriter& writer) {
  const vision::Keyframe& keyframe = in_map.keyframe;
  writer.integer(keyframe.id);
  writer.real(keyframe.time_s);
  writer.integer(static_cast<std::uint8_t>(keyframe.follows ? 1 : 0));
  writer.pose(keyframe.T_previous_keyframe);
  writer.matrix(keyframe.covariance);
  writer.pose(in_map.T_map_camera);
  writer.integer(static_cast<std::uint64_t>(keyframe.corners.size()));
  writer.integer(static_cast<std::uint8_t>(keyframe.scales()));
  for (const vision::KeyframeCorner& corner : keyframe.corners) {
    writer.integer(corner.landmark_id);
    for (const double value : {corner.px.x(), corner.px.y(), corner.disparity_px, corner.disparity_sigma_px})
      writer.single(value);
  }
  for (std::size_t i = 0; i < keyframe.scales() * keyframe.corners.size(); ++i)
    for (const std::uint64_t bits : keyframe.descriptors[i]) writer.integer(bits);
}

MapKeyframe readKeyframe(ByteReader& reader) {
  MapKeyframe in_map;
  vision::Keyframe& keyframe = in_map.keyframe;
  keyframe.id = reader.integer<std::uint32_t>();
  keyframe.time_s = reader.real();
  keyframe.follows = reader.flag();
  keyframe.T_previous_keyframe = reader.pose();
  keyframe.covariance = reader.matrix<Matrix6d>();
  in_map.T_map_camera = reader.pose();
  keyframe.corners.resize(reader.count(kCornerBytes));
  const std::size_t scales = reader.integer<std::uint8_t>();
  for (vision::KeyframeCorner& corner : keyframe.corners) {
    corner.landmark_id = reader.integer<std::uint64_t>();
    for (double* value : {&corner.px.x(), &corner.px.y(), &corner.disparity_px, &corner.disparity_sigma_px})
      *value = reader.single();
  }
  if (scales * keyframe.corners.size() > reader.left() / kDescriptorBytes)
    reader.fail("more descriptors than the section can hold");
  keyframe.descriptors.resize(scales * keyframe.corners.size());
  for (vision::Descriptor& descriptor : keyframe.descriptors)
    for (std::uint64_t& bits : descriptor) bits = reader.integer<std::uint64_t>();
  return in_map;
}

void writeKeyframes(const VisualMap& map, ByteWriter& writer) {
  writer.integer(static_cast<std::uint64_t>(map.keyframes.size()));
  for (const MapKeyframe& keyframe : map.keyframes) writeKeyframe(keyframe, writer);
}

void readKeyframes(ByteReader& reader, VisualMap& map) {
  for (std::size_t left = reader.count(kKeyframeBytes); left > 0; --left) {
    map.keyframes.push_back(readKeyframe(reader));
    const std::size_t n = map.keyframes.size();
    if (n > 1 && map.keyframes[n - 1].keyframe.id <= map.keyframes[n - 2].keyframe.id)
      reader.fail("ids of keyframes that do not increase");
  }
}

void writeLandmarks(const VisualMap& map, ByteWriter& writer) {
  writer.integer(static_cast<std::uint64_t>(map.landmarks.size()));
  for (const MapLandmark& landmark : map.landmarks) {
    writer.integer(landmark.id);
    writer.matrix(landmark.p_map);
  }
}

void readLandmarks(ByteReader& reader, VisualMap& map) {
  map.landmarks.resize(reader.count(kLandmarkBytes));
  for (std::size_t i = 0; i < map.landmarks.size(); ++i) {
    map.landmarks[i].id = reader.integer<std::uint64_t>();
    map.landmarks[i].p_map = reader.matrix<Eigen::Vector3d>();
    if (i > 0 && map.landmarks[i].id <= map.landmarks[i - 1].id)
      reader.fail("ids of landmarks that do not increase");
  }
}

void writeLoops(const VisualMap& map, ByteWriter& writer) {
  writer.integer(static_cast<std::uint64_t>(map.loops.size()));
  for (const MapLoop& loop : map.loops) {
    writer.integer(loop.from_id);
    writer.integer(loop.to_id);
    writer.pose(loop.T_from_to);
    writer.matrix(loop.covariance);
    writer.integer(static_cast<std::uint8_t>(loop.kept ? 1 : 0));
  }
}

void readLoops(ByteReader& reader, VisualMap& map) {
  map.loops.resize(reader.count(kLoopBytes));
  for (MapLoop& loop : map.loops) {
    loop.from_id = reader.integer<std::uint32_t>();
    loop.to_id = reader.integer<std::uint32_t>();
    loop.T_from_to = reader.pose();
    loop.covariance = reader.matrix<Matrix6d>();
    loop.kept = reader.flag();
    if (loop.from_id == loop.to_id || !indexOfKeyframe(map, loop.from_id) ||
        !indexOfKeyframe(map, loop.to_id))
      reader.fail("a loop with a keyframe that the map does not have, or with itself");
  }
}

void writeWorld(const VisualMap& map, ByteWriter& writer) {
  writer.integer(static_cast<std::uint8_t>(map.world ? 1 : 0));
  if (!map.world) return;
  writer.real(map.world->T_world_map.scale);
  writer.matrix(map.world->T_world_map.R_target_source);
  writer.matrix(map.world->T_world_map.t_target_m);
  writer.integer(static_cast<std::uint8_t>(map.world->freedom.scale ? 1 : 0));
  writer.integer(static_cast<std::uint8_t>(map.world->freedom.planar ? 1 : 0));
  writer.real(map.world->rms_m);
  writer.integer(static_cast<std::uint64_t>(map.world->residuals_m.size()));
  for (const double residual_m : map.world->residuals_m) writer.real(residual_m);
}

void readWorld(ByteReader& reader, VisualMap& map) {
  if (!reader.flag()) return;
  WorldTransform world;
  Similarity& similarity = world.T_world_map;
  similarity.scale = reader.real();
  similarity.R_target_source = reader.matrix<Eigen::Matrix3d>();
  similarity.t_target_m = reader.matrix<Eigen::Vector3d>();
  const Eigen::Matrix3d& R = similarity.R_target_source;
  if (!(similarity.scale > 0.0) || !(R.transpose() * R).isIdentity(1e-6) || R.determinant() < 0.0)
    reader.fail("a transform that is no rotation with a positive scale");
  world.freedom.scale = reader.flag();
  world.freedom.planar = reader.flag();
  world.rms_m = reader.real();
  world.residuals_m.resize(reader.count(sizeof(double)));
  for (double& residual_m : world.residuals_m) residual_m = reader.real();
  map.world = world;
}

}  // namespace

const std::vector<MapSection>& mapSections() {
  static const std::vector<MapSection> sections = {{"calibration", writeCalibration, readCalibration},
                                                   {"keyframes", writeKeyframes, readKeyframes},
                                                   {"landmarks", writeLandmarks, readLandmarks},
                                                   {"loops", writeLoops, readLoops},
                                                   {"world", writeWorld, readWorld}};
  return sections;
}

}  // namespace stereo_nav::mapping
