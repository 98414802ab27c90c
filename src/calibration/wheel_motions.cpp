#include "calibration/wheel_motions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/angles.h"
#include "core/planar_motion.h"

namespace stereo_nav::calibration {
namespace {

constexpr double kStep_s = 0.2;  // over which the reference's noise is small against what was driven
constexpr double kLeastAhead_m = 3.0;
constexpr double kLeastSideways_m = 2.0;
constexpr double kLeastTurns = 1.0;

void add(std::string& text, double seen, double needed, const char* what) {
  if (seen < needed) text += fmt::format("{}{:.1f} {} of {:g}", text.empty() ? "" : ", ", seen, what, needed);
}

}  // namespace

WheelMotions motionsOf(const std::vector<WheelRun>& runs) {
  WheelMotions motions;
  for (const WheelRun& run : runs) {
    for (std::size_t from = 0, to = 1; to < run.reference.size(); ++to) {
      if (run.reference[to].time_s - run.reference[from].time_s < kStep_s) continue;
      const Eigen::Vector3d motion = logPlanar(planarPart(run.reference[from].T_world_body).inverse() *
                                               planarPart(run.reference[to].T_world_body));
      motions.ahead_m += std::abs(motion.x());
      motions.sideways_m += std::abs(motion.y());
      (motion.z() > 0.0 ? motions.left_turns : motions.right_turns) += std::abs(motion.z()) / (2.0 * kPi);
      from = to;
    }
  }
  return motions;
}

std::string missingMotions(const WheelMotions& motions, const kinematics::Drive& drive) {
  const auto can = [&drive](const kinematics::Twist& twist) {
    return (drive.nearestPossible(twist) - twist).norm() < 1e-6;
  };
  std::string lacking;
  add(lacking, motions.ahead_m, kLeastAhead_m, "m ahead and back");
  if (can({0.0, 1.0, 0.0})) add(lacking, motions.sideways_m, kLeastSideways_m, "m sideways");
  add(lacking, motions.left_turns, kLeastTurns, "turns to the left");
  add(lacking, motions.right_turns, kLeastTurns, "turns to the right");
  if (lacking.empty()) return "";
  return "missing motions: " + lacking +
         "; drive the square of UMBmark (4 m a side, once around in each direction), or circles both ways, or a few "
         "minutes by the stick with whole turns to both sides" +
         (can({0.0, 1.0, 0.0}) ? " and stretches sideways" : "");
}

}  // namespace stereo_nav::calibration
