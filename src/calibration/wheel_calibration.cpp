#include "calibration/wheel_calibration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "calibration/wheel_fit.h"
#include "core/angles.h"
#include "stereo_nav/core/parameters.h"

namespace stereo_nav::calibration {
namespace {

// Slip shows over some seconds: shorter windows hold what does not add up, noise of the reference and of its
// stamps.
constexpr double kSlip_s = 5.0;
constexpr double kLongest_s = 60.0;  // of the windows that show what stays wrong on the whole way
constexpr std::size_t kLeastWindows = 4;

/// The value at which a falling function of it is 1, by bisection of its logarithm; an end where there is
/// none.
double whereOne(const std::function<double(double)>& mean_square, double low, double high) {
  if (mean_square(low) <= 1.0) return low;
  if (mean_square(high) >= 1.0) return high;
  for (int i = 0; i < 20; ++i) {
    const double middle = std::sqrt(low * high);
    (mean_square(middle) > 1.0 ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

/// Slip and error of the radii for which the covariances are as large as the errors. Where the noise of the
/// reference explains all of them, the slip stays as it was assumed: it cannot be told.
void findErrors(const WheelFit& fit, const WheelWindows& slip_windows, const WheelWindows& long_windows,
                odometry::WheelOdometryParams& params) {
  params.scale_sigma = 0.0;
  constexpr double kLeastSlip_m = 1e-5;
  const double slip_sigma_m = whereOne(
      [&](double tried_sigma_m) {
        odometry::WheelOdometryParams tried = params;
        tried.slip_sigma_m = tried_sigma_m;
        return fit.meanSquare(slip_windows, tried);
      },
      kLeastSlip_m, 0.3);
  if (slip_sigma_m > kLeastSlip_m) params.slip_sigma_m = slip_sigma_m;
  if (long_windows.windows().size() < kLeastWindows) return;  // chance
  params.scale_sigma = whereOne(
      [&](double scale_sigma) {
        odometry::WheelOdometryParams tried = params;
        tried.scale_sigma = scale_sigma;
        return fit.meanSquare(long_windows, tried);
      },
      1e-4, 0.1);
}

/// All fixed wheels are on one axle: what is known of its place and direction is known of each.
void shareAxle(WheelCalibration& result) {
  const WheelSigma* axle = nullptr;
  for (std::size_t w = 0; w < result.sigmas.size(); ++w) {
    if (result.params.drive.wheels[w].kind != kinematics::WheelKind::kFixed) continue;
    if (axle == nullptr) axle = &result.sigmas[w];
    result.sigmas[w].x_m = axle->x_m;
    result.sigmas[w].direction_deg = axle->direction_deg;
  }
}

/// Relative.
double meanRadiusSigma(const WheelCalibration& result) {
  double sum = 0.0;
  for (std::size_t w = 0; w < result.sigmas.size(); ++w)
    sum += result.sigmas[w].radius_m / result.params.drive.wheels[w].radius_m;
  return sum / static_cast<double>(result.sigmas.size());
}

/// Of the distance across between the two parallel plain or dead wheels that are furthest apart.
void findTrackWidth(const Eigen::MatrixXd& covariance, WheelCalibration& result) {
  const auto& wheels = result.params.drive.wheels;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double turned_deg = wrapDegrees(wheels[i].direction_deg - wheels[j].direction_deg);
      const double angle_rad = wheels[i].direction_deg * kRadPerDeg;
      const Eigen::Vector2d across(-std::sin(angle_rad), std::cos(angle_rad));
      const double width_m =
          std::abs(across.dot(Eigen::Vector2d(wheels[i].x_m - wheels[j].x_m, wheels[i].y_m - wheels[j].y_m)));
      if (std::abs(turned_deg) > 10.0 || width_m <= result.track_width_m) continue;
      Eigen::VectorXd gain = Eigen::VectorXd::Zero(covariance.rows());
      gain.segment<2>(static_cast<Eigen::Index>(4 * i + 1)) = across;
      gain.segment<2>(static_cast<Eigen::Index>(4 * j + 1)) = -across;
      result.track_width_m = width_m;
      result.track_width_sigma_m = std::sqrt(gain.dot(covariance * gain));
    }
  }
}

/// Names the wheels whose radius, or whose distance from the axis of turning, the runs leave open.
std::string undetermined(const WheelCalibration& result, const Eigen::MatrixXd& covariance,
                         const WheelCalibrationParams& params) {
  std::string names;
  const auto& wheels = result.params.drive.wheels;
  for (std::size_t w = 0; w < wheels.size(); ++w) {
    const double angle_rad = (wheels[w].direction_deg + wheels[w].roller_deg) * kRadPerDeg;
    const Eigen::Vector2d lever(std::sin(angle_rad), -std::cos(angle_rad));
    const double lever_sigma_m = std::sqrt(lever.dot(
        covariance.block<2, 2>(static_cast<Eigen::Index>(4 * w + 1), static_cast<Eigen::Index>(4 * w + 1)) *
        lever));
    const bool radius =
        result.sigmas[w].radius_m > params.max_share * params.radius_sigma * wheels[w].radius_m;
    const bool place = lever_sigma_m > params.max_share * params.position_sigma_m;
    if (!radius && !place) continue;
    names += fmt::format("{}{} of wheel_{} ({})", names.empty() ? "" : ", ",
                         radius && place ? "radius and position"
                         : radius        ? "radius"
                                         : "position",
                         w + 1, wheels[w].name);
  }
  return names;
}

}  // namespace

WheelCalibration calibrateWheels(const odometry::WheelOdometryParams& nominal,
                                 const std::vector<WheelRun>& runs, const WheelCalibrationParams& params) {
  validateParameters(params, "calibration of the wheels");
  const double margin_s = 3.0 * params.time_offset_sigma_s;
  const WheelWindows windows(nominal, runs, params.window_s, margin_s);
  const WheelWindows slip_windows(nominal, runs, std::max(kSlip_s, params.window_s), margin_s);
  const WheelWindows long_windows(nominal, runs, kLongest_s, margin_s);
  WheelCalibration result;
  result.params = nominal;
  result.windows = windows.windows().size();
  result.motions = motionsOf(runs);
  const std::string missing = missingMotions(result.motions, kinematics::Drive(nominal.drive));
  if (result.windows < kLeastWindows) {
    result.refusal = fmt::format(
        "only {} pieces of {:g} s in which the wheels move and the reference covers them; {} are needed. Does the "
        "reference have the clock of wheel_ticks? {}",
        result.windows, params.window_s, kLeastWindows, missing);
    return result;
  }
  WheelFit fit(windows, nominal, runs.size(), params);
  for (int pass = 0; pass < 3; ++pass) {
    fit.solve();
    findErrors(fit, slip_windows.windows().size() < kLeastWindows ? windows : slip_windows, long_windows,
               result.params);
    fit.setErrors(result.params);
  }
  fit.solve();
  result.params.drive = fit.drive();
  result.reference_scale = fit.referenceScale();
  for (std::size_t r = 0; r < runs.size(); ++r) result.time_offsets_s.push_back(fit.timeOffset_s(r));
  result.nominal = fit.agreement(true);
  result.found = fit.agreement(false);
  const Eigen::MatrixXd covariance = fit.wheelCovariance();
  const Eigen::VectorXd sigmas = covariance.diagonal().cwiseSqrt();
  for (std::size_t w = 0; w < nominal.drive.wheels.size(); ++w) {
    const auto first = static_cast<Eigen::Index>(4 * w);
    result.sigmas.push_back({sigmas(first) * result.params.drive.wheels[w].radius_m, sigmas(first + 1),
                             sigmas(first + 2), sigmas(first + 3) * kDegPerRad});
  }
  shareAxle(result);
  result.params.scale_sigma = std::max(result.params.scale_sigma, meanRadiusSigma(result));
  findTrackWidth(covariance, result);
  const std::string open = undetermined(result, covariance, params);
  if (!open.empty()) {
    result.refusal = "the runs do not determine the " + open + "; " +
                     (missing.empty() ? "drive longer, with whole turns to both sides" : missing);
  }
  return result;
}

void WheelCalibrationParams::describe(ParameterVisitor& visitor) {
  visitor.real("window_s", window_s, {0.5, 60.0}, "s", "over which motions are compared");
  visitor.real("radius_sigma", radius_sigma, {1e-4, 0.5}, "",
               "what the nominal radii may be off by, relative");
  visitor.real("position_sigma_m", position_sigma_m, {1e-4, 1.0}, "m",
               "what the contact points may be off by");
  visitor.real("direction_sigma_deg", direction_sigma_deg, {1e-3, 45.0}, "deg",
               "what the directions may be off by");
  visitor.real("reference_sigma_m", reference_sigma_m, {1e-6, 1.0}, "m",
               "noise of the reference's positions");
  visitor.real("reference_sigma_deg", reference_sigma_deg, {1e-4, 45.0}, "deg",
               "noise of the reference's headings");
  visitor.real("reference_walk_m", reference_walk_m, {0.0, 1.0}, "m",
               "drift of the reference's position on 1 m; grows with the root of the way");
  visitor.real("reference_walk_deg", reference_walk_deg, {0.0, 45.0}, "deg",
               "drift of the reference's heading on 1 m; grows with the root of the way");
  visitor.real("reference_scale_sigma", reference_scale_sigma, {0.0, 0.2}, "",
               "error of all lengths of the reference in common, relative");
  visitor.real("time_offset_sigma_s", time_offset_sigma_s, {0.0, 1.0}, "s",
               "constant error of the reference's stamps in each run");
  visitor.real(
      "max_share", max_share, {0.01, 1.0}, "",
      "a radius or position counts as found when its deviation is below this share of what was assumed");
}

}  // namespace stereo_nav::calibration
