#include "sim/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angles.h"
#include "sim/random.h"

namespace stereo_nav::sim {
namespace {

struct Interval {
  double near, far;
};

Interval slab(double origin, double direction, double half) {
  const double a = (-half - origin) / direction, b = (half - origin) / direction;
  return {std::min(a, b), std::max(a, b)};
}

Interval intersect(Interval a, Interval b) {
  return {std::max(a.near, b.near), std::min(a.far, b.far)};
}

Interval cylinderSide(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double radius) {
  const double a = direction.head<2>().squaredNorm(), b = origin.head<2>().dot(direction.head<2>());
  const double discriminant = b * b - a * (origin.head<2>().squaredNorm() - radius * radius);
  if (discriminant < 0.0) return {1.0, 0.0};
  const double root = std::sqrt(discriminant);
  return {(-b - root) / a, (-b + root) / a};
}

}  // namespace

Eigen::Vector3d Solid::position(double time_s) const {
  if (walk_m.isZero()) return p_world;
  const double swing = 0.5 - 0.5 * std::cos(2.0 * kPi * (time_s / walk_period_s + walk_phase));
  return p_world + Eigen::Vector3d(walk_m.x() * swing, walk_m.y() * swing, 0.0);
}

Scene::Scene(const SceneParams& params) : world_seed_(static_cast<std::uint64_t>(params.world_seed)) {
  addRoom(params.room);
  for (const ObjectParams& object : params.objects) {
    if (object.glass) {
      addPane(object);
    } else {
      addObject(object);
    }
  }
  for (std::size_t i = 0; i < params.clutter.size(); ++i) scatter(params.clutter[i], i);
}

Surface Scene::makeSurface(const Material& material, std::uint64_t instance) {
  std::shared_ptr<Texture>& texture = textures_[material.texture];
  if (!texture) texture = std::make_shared<Texture>(material.texture, world_seed_);
  Surface surface;
  surface.texture = texture.get();
  surface.grey = static_cast<float>(255.0 * material.brightness);
  surface.contrast = static_cast<float>(material.contrast);
  surface.texels_per_m = static_cast<float>(1e3 / material.texel_mm);
  if (material.texture != TextureKind::kChecker) {
    RandomStream random(streamKey(world_seed_, Stream::kClutter, 7, instance));
    surface.u_offset = static_cast<float>(random.uniform(0, Texture::kSize));
    surface.v_offset = static_cast<float>(random.uniform(0, Texture::kSize));
  }
  return surface;
}

void Scene::addRoom(const RoomParams& room) {
  Solid solid;
  solid.kind = Solid::Kind::kRoom;
  solid.name = "wall";
  solid.p_world = {0.5 * (room.x_min_m + room.x_max_m), 0.5 * (room.y_min_m + room.y_max_m),
                   0.5 * room.height_m};
  solid.half = {static_cast<float>(0.5 * (room.x_max_m - room.x_min_m)),
                static_cast<float>(0.5 * (room.y_max_m - room.y_min_m)),
                static_cast<float>(0.5 * room.height_m)};
  solid.inverse_half = solid.half.cwiseInverse();
  solid.sides = makeSurface(room.walls, 1);
  solid.floor = makeSurface(room.floor, 2);
  solid.top = makeSurface(room.ceiling, 3);
  solids_.push_back(solid);
  if (room.floor_gloss == 0.0) return;
  Mirror floor;
  floor.T_world_mirror.translation() << solid.p_world.head<2>(), 0.0;
  floor.half_x_m = solid.half.x();
  floor.half_y_m = solid.half.y();
  floor.reflectance = room.floor_gloss;
  mirrors_.push_back(floor);
}

/// A pane mirrors at both of its surfaces, 4 % each; its thickness does not matter.
void Scene::addPane(const ObjectParams& object) {
  constexpr double kReflectance = 0.08;
  const bool along_x = object.length_m >= object.width_m;
  Mirror pane;
  pane.half_x_m = 0.5 * std::max(object.length_m, object.width_m);
  pane.half_y_m = 0.5 * object.height_m;
  pane.reflectance = kReflectance;
  const double yaw_rad = (object.yaw_deg + (along_x ? 0.0 : 90.0)) * kRadPerDeg;
  pane.T_world_mirror.linear() = (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(0.5 * kPi, Eigen::Vector3d::UnitX()))
                                     .toRotationMatrix();
  for (int i = 0; i < object.repeats; ++i) {
    pane.T_world_mirror.translation() << object.x_m + i * object.repeat_x_m,
        object.y_m + i * object.repeat_y_m, object.bottom_m + 0.5 * object.height_m;
    mirrors_.push_back(pane);
  }
}

void Scene::addObject(const ObjectParams& object) {
  Solid solid;
  const bool box = object.shape == Shape::kBox;
  solid.kind = box ? Solid::Kind::kBox : Solid::Kind::kCylinder;
  solid.p_world = {object.x_m, object.y_m, object.bottom_m + 0.5 * object.height_m};
  solid.R_solid_world =
      Eigen::AngleAxisd(-object.yaw_deg * kRadPerDeg, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  solid.half = {static_cast<float>(0.5 * object.length_m),
                static_cast<float>(0.5 * (box ? object.width_m : object.length_m)),
                static_cast<float>(0.5 * object.height_m)};
  solid.inverse_half = solid.half.cwiseInverse();
  solid.sides = makeSurface(object.material, 10 + solids_.size());
  solid.floor = solid.top = solid.sides;
  solid.walk_m = {object.walk_x_m, object.walk_y_m};
  solid.walk_period_s = object.walk_period_s;
  solid.walk_phase = object.walk_phase;
  solid.waits_m = object.waits_m;
  solid.from_s = object.from_s;
  solid.to_s = object.to_s;
  solid.movable = object.movable;
  solid.name = object.name.empty() ? "object " + std::to_string(solids_.size()) : object.name;
  for (int i = 0; i < object.repeats; ++i) {
    solids_.push_back(solid);
    solid.p_world += Eigen::Vector3d(object.repeat_x_m, object.repeat_y_m, 0.0);
  }
}

void Scene::scatter(const ClutterParams& clutter, std::uint64_t index) {
  RandomStream random(streamKey(world_seed_, Stream::kClutter, index));
  for (int i = 0; i < clutter.count; ++i) {
    ObjectParams object;
    object.shape = clutter.shape;
    object.x_m = random.uniform(clutter.x_min_m, clutter.x_max_m);
    object.y_m = random.uniform(clutter.y_min_m, clutter.y_max_m);
    object.yaw_deg = random.uniform(-180.0, 180.0);
    object.length_m = random.uniform(clutter.size_min_m, clutter.size_max_m);
    object.width_m = random.uniform(clutter.size_min_m, clutter.size_max_m);
    object.height_m = random.uniform(clutter.height_min_m, clutter.height_max_m);
    object.material = clutter.material;
    object.material.brightness *= random.uniform(0.7, 1.3);
    addObject(object);
  }
}

std::vector<const Solid*> Scene::solidsAt(double time_s) const {
  std::vector<const Solid*> solids;
  for (const Solid& solid : solids_) {
    if (solid.isThere(time_s)) solids.push_back(&solid);
  }
  return solids;
}

double Scene::castRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double time_s) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Solid& solid : solids_) {
    if (!solid.isThere(time_s)) continue;
    const Eigen::Vector3d o = solid.R_solid_world * (origin - solid.position(time_s));
    const Eigen::Vector3d d = solid.R_solid_world * direction;
    Interval hit = slab(o.z(), d.z(), solid.half.z());
    if (solid.kind == Solid::Kind::kCylinder) {
      hit = intersect(hit, cylinderSide(o, d, solid.half.x()));
    } else {
      hit = intersect(hit, slab(o.x(), d.x(), solid.half.x()));
      hit = intersect(hit, slab(o.y(), d.y(), solid.half.y()));
    }
    const double distance = solid.kind == Solid::Kind::kRoom ? hit.far : hit.near;
    if (hit.near <= hit.far && distance > 0.0) nearest = std::min(nearest, distance);
  }
  return nearest;
}

}  // namespace stereo_nav::sim
