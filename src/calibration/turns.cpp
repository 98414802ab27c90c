#include "calibration/turns.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "core/angles.h"

namespace stereo_nav::calibration {
namespace {

/// An axis of the camera in words.
std::string axisName(const Eigen::Vector3d& axis) {
  const char* names[] = {"the camera's x axis (nodding)", "the camera's y axis (looking left and right)",
                         "the camera's z axis (tilting to the side)"};
  Eigen::Index largest;
  axis.cwiseAbs().maxCoeff(&largest);
  return names[largest];
}

}  // namespace

std::vector<Turn> turnsOf(const std::vector<CameraOrientation>& camera, double interval_s) {
  std::vector<Turn> turns;
  if (camera.empty()) return turns;
  // Stamps of a steady camera may fall a little short of a multiple of its period.
  constexpr double kSlack_s = 1e-3;
  const CameraOrientation* start = &camera.front();
  for (const CameraOrientation& now : camera) {
    if (now.run != start->run) start = &now;
    if (now.time_s - start->time_s < interval_s - kSlack_s) continue;
    turns.push_back(
        {start->time_s, now.time_s, logRotation(start->R_start_camera.transpose() * now.R_start_camera)});
    start = &now;
  }
  return turns;
}

ImuTurns::ImuTurns(const std::vector<ImuSample>& samples, const Eigen::Vector3d& bias_rad_s)
    : history_(std::numeric_limits<double>::infinity()) {
  for (ImuSample sample : samples) {
    if (sample.angular_velocity) *sample.angular_velocity -= bias_rad_s;
    history_.add(sample);
  }
}

std::optional<Eigen::Vector3d> ImuTurns::turn(const Turn& camera, double offset_s) const {
  // increment() takes the earlier frame's coordinates into the later one's.
  const auto R_current_previous = history_.increment(camera.from_s + offset_s, camera.to_s + offset_s);
  if (!R_current_previous) return std::nullopt;
  return logRotation(R_current_previous->transpose());
}

std::string refuseData(const std::vector<Turn>& turns, const std::vector<ImuSample>& imu,
                       const ImuCameraRotationParams& params) {
  std::ostringstream text;
  if (imu.empty()) {
    text << "no IMU samples: record imu/data, too, with imu_bridge running";
  } else if (turns.size() < static_cast<std::size_t>(params.min_turns)) {
    text << "the cameras saw only " << turns.size() << " turns of " << params.interval_s << " s, "
         << params.min_turns
         << " are needed: record half a minute in a well-lit place with texture, and turn no faster than the "
            "images stay sharp";
  } else {
    const ImuTurns imu_turns(imu, Eigen::Vector3d::Zero());
    std::size_t shared = 0;
    for (const Turn& turn : turns) shared += imu_turns.turn(turn, 0.0) ? 1 : 0;
    if (2 * shared < turns.size()) {
      text << "the IMU covers " << shared << " of " << turns.size()
           << " turns of the cameras: are both stamped by "
           << "one clock? IMU from " << std::fixed << imu.front().time_s << " to " << imu.back().time_s
           << " s, cameras from " << turns.front().from_s << " to " << turns.back().to_s << " s";
    }
  }
  return text.str();
}

std::string refuseResult(const ImuCameraRotation& result, bool mirrored,
                         const ImuCameraRotationParams& params) {
  std::ostringstream text;
  text.precision(3);
  const double first_deg_s = result.rate_rms_rad_s(0) / kRadPerDeg,
               second_deg_s = result.rate_rms_rad_s(1) / kRadPerDeg;
  if (first_deg_s < params.min_rate_deg_s) {
    text << "the rig hardly turned (" << first_deg_s
         << " deg/s RMS): turn it by some 30 deg to and fro about all three axes, a few seconds each";
  } else if (second_deg_s < params.min_rate_deg_s) {
    text << "the motion had too few axes: " << first_deg_s << " deg/s RMS about "
         << axisName(result.motion_axes.col(0)) << ", only " << second_deg_s
         << " about the next one. The rotation of the IMU about that axis cannot be "
            "observed in this way: turn the rig about the other two as well (tilt and nod it by 20 deg, "
            "by hand)";
  } else if (mirrored) {
    text << "the IMU's axes are mirrored (left-handed): one of its angles has the wrong sign or they are in "
            "the wrong order; see angle_order in docs/imu.md";
  } else if (result.residual_rms_rad > params.max_residual_share * result.turn_rms_rad) {
    text << "cameras and IMU disagree by " << result.residual_rms_rad / kRadPerDeg << " deg in turns of "
         << result.turn_rms_rad / kRadPerDeg
         << " deg: is the IMU fixed to the cameras, does it send what its "
         << "protocol says, and are its stamps within " << params.max_offset_s << " s?";
  } else if (std::abs(result.imu_offset_s) > params.max_offset_s) {
    text << "the IMU's stamps would be off by more than " << params.max_offset_s
         << " s, which is more than the range that is searched: correct them first";
  } else if (!(result.sigma_rad.maxCoeff() < params.max_sigma_deg * kRadPerDeg)) {
    text << "uncertain by " << result.sigma_rad.maxCoeff() / kRadPerDeg << " deg (" << params.max_sigma_deg
         << " allowed): record longer, and turn more about all three axes";
  }
  return text.str();
}

}  // namespace stereo_nav::calibration
