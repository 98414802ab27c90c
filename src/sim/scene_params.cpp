#include "sim/scene.h"

namespace stereo_nav::sim {
namespace {

constexpr Range<double> kPlace{-100.0, 100.0};
constexpr Range<double> kExtent{0.001, 100.0};

void describeShape(ParameterVisitor& visitor, Shape& shape) {
  visitEnum(visitor, "shape", shape, {{"box", Shape::kBox}, {"cylinder", Shape::kCylinder}}, "its shape");
}

}  // namespace

void Material::describe(ParameterVisitor& visitor) {
  visitEnum(visitor, "texture", texture, textureNames(), "what the surface looks like");
  visitor.real("brightness", brightness, {0.0, 100.0}, "",
               "mean grey level in full light, 1 is white; lamps and windows are brighter");
  visitor.real("contrast", contrast, {0.0, 4.0}, "", "strength of the texture, 0 is a plain surface");
  visitor.real("texel_mm", texel_mm, {0.1, 100.0}, "mm", "size of a texel; the texture repeats after 1024");
}

void ObjectParams::describe(ParameterVisitor& visitor) {
  visitor.text("name", name, "what reports of contacts call it; empty: its number");
  describeShape(visitor, shape);
  visitor.real("x_m", x_m, kPlace, "m", "position of the middle, forward from the start");
  visitor.real("y_m", y_m, kPlace, "m", "position of the middle, left of the start");
  visitor.real("yaw_deg", yaw_deg, {-360.0, 360.0}, "deg", "turned about the vertical, counter-clockwise");
  visitor.real("length_m", length_m, kExtent, "m", "extent along its own x axis; a cylinder's diameter");
  visitor.real("width_m", width_m, kExtent, "m", "extent along its own y axis; a cylinder has none");
  visitor.real("height_m", height_m, kExtent, "m", "vertical extent");
  visitor.real("bottom_m", bottom_m, {0.0, 100.0}, "m", "height of the underside above the floor");
  visitSection(visitor, "material", material);
  visitor.real("walk_x_m", walk_x_m, kPlace, "m", "it walks this far forward and back");
  visitor.real("walk_y_m", walk_y_m, kPlace, "m", "it walks this far left and back");
  visitor.real("walk_period_s", walk_period_s, {0.1, 1e4}, "s", "time for there and back");
  visitor.real("walk_phase", walk_phase, {0.0, 1.0}, "", "share of the period that has passed at the start");
  visitor.real("waits_m", waits_m, {0.0, 10.0}, "m",
               "while it walks it stops this far from a driven robot that stands in its way; 0: it walks on");
  visitor.real("from_s", from_s, {-1e9, 1e9}, "s", "it appears at this time");
  visitor.real("to_s", to_s, {0.0, 1e9}, "s", "it vanishes at this time");
  visitor.flag("movable", movable, "a driven robot pushes it; it does not turn");
  visitor.flag("glass", glass, "a pane of glass in the middle of its thinner side, at rest");
  visitor.integer("repeats", repeats, {1, 1000}, "", "it stands there so often and looks the same each time");
  visitor.real("repeat_x_m", repeat_x_m, kPlace, "m", "forward, from one to the next");
  visitor.real("repeat_y_m", repeat_y_m, kPlace, "m", "to the left, from one to the next");
}

void RoomParams::describe(ParameterVisitor& visitor) {
  visitor.real("x_min_m", x_min_m, kPlace, "m", "wall behind the start");
  visitor.real("x_max_m", x_max_m, kPlace, "m", "wall ahead");
  visitor.real("y_min_m", y_min_m, kPlace, "m", "wall on the right");
  visitor.real("y_max_m", y_max_m, kPlace, "m", "wall on the left");
  visitor.real("height_m", height_m, kExtent, "m", "of the ceiling");
  visitor.real("floor_gloss", floor_gloss, {0.0, 1.0}, "",
               "share of the light that the floor mirrors straight down, more at a slant: 0.04 is varnish");
  visitSection(visitor, "floor", floor);
  visitSection(visitor, "walls", walls);
  visitSection(visitor, "ceiling", ceiling);
}

void ClutterParams::describe(ParameterVisitor& visitor) {
  visitor.integer("count", count, {0, 1000}, "", "number of objects");
  describeShape(visitor, shape);
  visitor.real("x_min_m", x_min_m, kPlace, "m", "rectangle of the floor they stand on");
  visitor.real("x_max_m", x_max_m, kPlace, "m", "rectangle of the floor they stand on");
  visitor.real("y_min_m", y_min_m, kPlace, "m", "rectangle of the floor they stand on");
  visitor.real("y_max_m", y_max_m, kPlace, "m", "rectangle of the floor they stand on");
  visitor.real("size_min_m", size_min_m, kExtent, "m", "smallest horizontal extent");
  visitor.real("size_max_m", size_max_m, kExtent, "m", "largest horizontal extent");
  visitor.real("height_min_m", height_min_m, kExtent, "m", "lowest");
  visitor.real("height_max_m", height_max_m, kExtent, "m", "highest");
  visitSection(visitor, "material", material);
}

}  // namespace stereo_nav::sim
