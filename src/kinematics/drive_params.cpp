#include "kinematics/drive_params.h"

#include "core/angles.h"
#include "core/parameter_list.h"

namespace stereo_nav::kinematics {

double WheelParams::metresPerPulse() const {
  return (encoder_reversed ? -2.0 : 2.0) * kPi * radius_m / pulses_per_turn;
}

void WheelParams::describe(ParameterVisitor& visitor) {
  visitor.text("name", name, "what messages call this wheel");
  visitEnum(
      visitor, "kind", kind,
      {{"rollers", WheelKind::kRollers}, {"fixed", WheelKind::kFixed}, {"steered", WheelKind::kSteered}},
      "rollers: omni, mecanum and dead wheels; fixed and steered: plain wheels");
  visitor.real("x_m", x_m, {-50.0, 50.0}, "m", "contact point in base_link, forward");
  visitor.real("y_m", y_m, {-50.0, 50.0}, "m", "contact point in base_link, left");
  visitor.real("direction_deg", direction_deg, {-360.0, 360.0}, "deg",
               "where the wheel rolls at a steering angle of zero, counterclockwise from forward");
  visitor.real("roller_deg", roller_deg, {-80.0, 80.0}, "deg",
               "direction in which a roller drives the base, counterclockwise from the wheel's: 0 for omni "
               "wheels, 45 or -45 for mecanum wheels");
  visitor.real("radius_m", radius_m, {1e-3, 10.0}, "m", "effective radius");
  visitor.real("max_steering_deg", max_steering_deg, {0.0, 360.0}, "deg",
               "largest steering angle to either side; 180 and more turn without end");
  visitor.real(
      "pulses_per_turn", pulses_per_turn, {1.0, 1e7}, "",
      "pulses of the encoder in one turn of the wheel, with the gear and all edges that are counted");
  visitor.flag("encoder_reversed", encoder_reversed,
               "the encoder counts down when the wheel rolls in its direction");
}

void DriveParams::describe(ParameterVisitor& visitor) {
  visitList(visitor, "wheels", "wheel", wheels, 16, "number of wheels");
}

}  // namespace stereo_nav::kinematics
