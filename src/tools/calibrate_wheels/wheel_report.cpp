#include "tools/calibrate_wheels/wheel_report.h"

#include <cstdio>
#include <string>

namespace stereo_nav::tools {
namespace {

/// A value about which the runs tell nothing keeps the nominal one.
void printValue(const char* name, double nominal, double found, double sigma, double assumed_sigma,
                int digits, const char* unit) {
  if (sigma > 0.9 * assumed_sigma) {
    std::printf("  %-14s %.*f %s, not seen by these runs\n", name, digits, nominal, unit);
  } else {
    std::printf("  %-14s %.*f -> %.*f %s, deviation %.*f\n", name, digits, nominal, digits, found, unit,
                digits, sigma);
  }
}

void printAgreement(const char* name, const calibration::WheelAgreement& agreement) {
  std::printf("  %-14s %.1f mm, %.2f deg\n", name, 1e3 * agreement.translation_rms_m,
              agreement.rotation_rms_deg);
}

}  // namespace

void printCalibration(const calibration::WheelCalibration& found, const kinematics::DriveParams& nominal,
                      const calibration::WheelCalibrationParams& params) {
  const calibration::WheelMotions& motions = found.motions;
  std::printf(
      "driven: %.1f m ahead and back, %.1f m sideways, %.1f turns to the left, %.1f to the right; %zu pieces of "
      "%g s\n",
      motions.ahead_m, motions.sideways_m, motions.left_turns, motions.right_turns, found.windows,
      params.window_s);
  for (std::size_t i = 0; i < found.sigmas.size(); ++i) {
    const auto& before = nominal.wheels[i];
    const auto& after = found.params.drive.wheels[i];
    const calibration::WheelSigma& sigma = found.sigmas[i];
    std::printf("wheel_%zu (%s)\n", i + 1, after.name.c_str());
    printValue("radius", 1e3 * before.radius_m, 1e3 * after.radius_m, 1e3 * sigma.radius_m,
               1e3 * params.radius_sigma * before.radius_m, 4, "mm");
    printValue("x", 1e3 * before.x_m, 1e3 * after.x_m, 1e3 * sigma.x_m, 1e3 * params.position_sigma_m, 2,
               "mm");
    printValue("y", 1e3 * before.y_m, 1e3 * after.y_m, 1e3 * sigma.y_m, 1e3 * params.position_sigma_m, 2,
               "mm");
    printValue("direction", before.direction_deg, after.direction_deg, sigma.direction_deg,
               params.direction_sigma_deg, 3, "deg");
  }
  if (found.track_width_m > 0.0)
    std::printf("track width: %.2f mm, deviation %.2f mm\n", 1e3 * found.track_width_m,
                1e3 * found.track_width_sigma_m);
  if (params.reference_scale_sigma > 0.0)
    std::printf("lengths of the reference: times %.5f\n", found.reference_scale);
  std::printf("lateness of the reference:");
  for (const double offset_s : found.time_offsets_s) std::printf(" %.1f", 1e3 * offset_s);
  std::printf(" ms\nwheels against the reference, RMS over the pieces\n");
  printAgreement("nominal", found.nominal);
  printAgreement("calibrated", found.found);
  std::printf("errors that are left: slip_sigma_m %.5f, scale_sigma %.5f\n", found.params.slip_sigma_m,
              found.params.scale_sigma);
}

}  // namespace stereo_nav::tools
