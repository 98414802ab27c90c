// Parameters with ranges from YAML, a rigid motion and back, a trajectory as text.
#include <stereo_nav/core/input_error.h>
#include <stereo_nav/core/parameters.h>
#include <stereo_nav/core/trajectory.h>

#include "expect.h"

namespace {

struct SpeedParams {
  double limit_m_s = 1.0;

  void describe(stereo_nav::ParameterVisitor& visitor) {
    visitor.real("limit_m_s", limit_m_s, {0.0, 2.0}, "m/s", "fastest that the robot may drive");
  }
};

}  // namespace

int main() {
  SpeedParams params;
  stereo_nav::readParameters(YAML::Load("limit_m_s: 1.5"), "use_core", params);
  expect(params.limit_m_s == 1.5, "the parameter is read");
  bool refused = false;
  try {
    stereo_nav::readParameters(YAML::Load("limit_m_s: 3.0"), "use_core", params);
  } catch (const stereo_nav::ParameterError&) {
    refused = true;
  }
  expect(refused, "a value out of range is refused");

  bool told = false;
  try {
    stereo_nav::readTum("no_such_file.tum");
  } catch (const stereo_nav::InputError&) {
    told = true;
  }
  expect(told, "a file that does not exist is told from other errors");

  stereo_nav::StampedPose end;
  end.time_s = 1.0;
  end.T_world_body.translation().x() = 2.0;
  const stereo_nav::Trajectory trajectory = {stereo_nav::StampedPose(), end};
  expect(stereo_nav::pathLength(trajectory) == 2.0, "the path is 2 m long");
  expect(!stereo_nav::toTum(trajectory).empty(), "the trajectory has a text");
}
