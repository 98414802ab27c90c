#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/mirror.h"
#include "sim/texture.h"
#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::sim {

/// How a surface reflects: grey = 255 * brightness * (1 + contrast * texture) in full light.
struct Material {
  TextureKind texture = TextureKind::kPlain;
  double brightness = 0.5;
  double contrast = 1.0;
  double texel_mm = 4.0;

  void describe(ParameterVisitor& visitor);
};

enum class Shape { kBox, kCylinder };

/// Something that stands or walks in the world. World frame: x and y on the floor, z up, metres.
struct ObjectParams {
  std::string name;  ///< what reports of contacts call it
  Shape shape = Shape::kBox;
  double x_m = 0.0;  ///< centre
  double y_m = 0.0;
  double yaw_deg = 0.0;
  double length_m = 0.5;  ///< along its own x axis; a cylinder's diameter
  double width_m = 0.5;   ///< along its own y axis; not used by a cylinder
  double height_m = 0.5;
  double bottom_m = 0.0;  ///< height of its underside above the floor
  Material material;
  double walk_x_m = 0.0;  ///< walks from the centre to centre + walk and back, smoothly
  double walk_y_m = 0.0;
  double walk_period_s = 10.0;
  double walk_phase = 0.0;  ///< share of the period that has passed at time 0
  double waits_m = 0.0;     ///< it waits so far from a driven robot that stands in its way; 0: it walks on
  double from_s = -1e9;     ///< it is there from this time on,
  double to_s = 1e9;        ///< until this one
  bool movable = false;     ///< a driven robot pushes it
  bool glass = false;       ///< a pane: shows what is behind it, mirrors what is before it
  int repeats = 1;          ///< it stands there so often, and looks the same each time
  double repeat_x_m = 0.0;  ///< from one to the next
  double repeat_y_m = 0.0;

  void describe(ParameterVisitor& visitor);
};

/// The hall around everything: floor, four walls, ceiling.
struct RoomParams {
  double x_min_m = -5.0;
  double x_max_m = 15.0;
  double y_min_m = -8.0;
  double y_max_m = 8.0;
  double height_m = 5.0;
  double floor_gloss = 0.0;  ///< share of the light that the floor mirrors straight down, 0 is matt
  Material floor;
  Material walls;
  Material ceiling;

  void describe(ParameterVisitor& visitor);
};

/// Objects strewn at random over a rectangle of the floor, between the sizes given. They are the same for the
/// same world seed.
struct ClutterParams {
  int count = 10;
  Shape shape = Shape::kBox;
  double x_min_m = 0.0;
  double x_max_m = 1.0;
  double y_min_m = 0.0;
  double y_max_m = 1.0;
  double size_min_m = 0.2;
  double size_max_m = 0.8;
  double height_min_m = 0.3;
  double height_max_m = 1.5;
  Material material;

  void describe(ParameterVisitor& visitor);
};

struct SceneParams {
  int world_seed = 1;  ///< textures and clutter; apart from a run's seed, so that the world stays the same
  RoomParams room;
  std::vector<ObjectParams> objects;
  std::vector<ClutterParams> clutter;
};

/// A surface as the renderer sees it.
struct Surface {
  const Texture* texture = nullptr;
  float grey = 128.0f;  ///< 255 * brightness
  float contrast = 1.0f;
  float texels_per_m = 250.0f;
  float u_offset = 0.0f;  ///< texels; another piece of the texture for every object
  float v_offset = 0.0f;
};

/// A solid whose local frame has its origin in the middle, z up. The room is a box seen from inside.
struct Solid {
  enum class Kind { kRoom, kBox, kCylinder };
  Kind kind = Kind::kBox;
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();            ///< of the middle at rest
  Eigen::Matrix3d R_solid_world = Eigen::Matrix3d::Identity();  ///< a turn about the vertical
  Eigen::Vector3f half = Eigen::Vector3f::Constant(0.5f);  ///< half extents; a cylinder's radius in x and y
  Eigen::Vector3f inverse_half = Eigen::Vector3f::Constant(2.0f);
  Surface sides;
  Surface floor;  ///< room only
  Surface top;    ///< room: ceiling
  Eigen::Vector2d walk_m = Eigen::Vector2d::Zero();
  double walk_period_s = 1.0;
  double walk_phase = 0.0;
  double waits_m = 0.0;
  double from_s = -1e9;  ///< before 0, too: the first exposure begins before its middle
  double to_s = 1e9;
  bool movable = false;
  std::string name;

  bool isThere(double time_s) const { return time_s >= from_s && time_s < to_s; }
  /// Middle at a time.
  Eigen::Vector3d position(double time_s) const;
};

/// All solids with their textures. Threads share it while nothing is moved; a copy, which shares the
/// textures, is the scene of its moment.
class Scene {
 public:
  explicit Scene(const SceneParams& params);

  const std::vector<Solid>& solids() const { return solids_; }
  /// Those that are there at a time.
  std::vector<const Solid*> solidsAt(double time_s) const;
  /// Moves a solid over the floor.
  void move(std::size_t solid, const Eigen::Vector2d& way_m) { solids_[solid].p_world.head<2>() += way_m; }
  /// Holds one that walks where it is for a moment.
  void hold(std::size_t solid, double duration_s) {
    solids_[solid].walk_phase -= duration_s / solids_[solid].walk_period_s;
  }
  /// Glossy floor first, then panes of glass, which no ray of castRay() meets.
  const std::vector<Mirror>& mirrors() const { return mirrors_; }

  /// Distance along a ray (in lengths of `direction`) to the first surface, for tests and for depth truth.
  double castRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double time_s) const;

 private:
  Surface makeSurface(const Material& material, std::uint64_t instance);
  void addRoom(const RoomParams& room);
  void addObject(const ObjectParams& object);
  void addPane(const ObjectParams& object);
  void scatter(const ClutterParams& clutter, std::uint64_t index);

  std::uint64_t world_seed_;
  std::map<TextureKind, std::shared_ptr<Texture>> textures_;
  std::vector<Solid> solids_;
  std::vector<Mirror> mirrors_;
};

}  // namespace stereo_nav::sim
