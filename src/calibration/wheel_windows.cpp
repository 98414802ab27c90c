#include "calibration/wheel_windows.h"

#include <algorithm>
#include <cmath>

#include "core/planar_motion.h"
#include "eval/alignment.h"
#include "odometry/wheel/pulse_counter.h"

namespace stereo_nav::calibration {

WheelWindows::WheelWindows(const odometry::WheelOdometryParams& params, const std::vector<WheelRun>& runs,
                           double window_s, double margin_s)
    : runs_(runs) {
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto& samples = runs[r].samples;
    std::vector<Step> steps;
    for (std::size_t i = 1; i < samples.size(); ++i) {
      Step step{{}, {}, samples[i].time_s - samples[i - 1].time_s};
      for (std::size_t w = 0; w < samples[i].pulses.size(); ++w) {
        step.pulses.push_back(static_cast<double>(
            odometry::pulsesBetween(samples[i - 1].pulses[w], samples[i].pulses[w], params.counter_bits)));
      }
      for (std::size_t w = 0; w < samples[i].steering_rad.size(); ++w)
        step.steering_rad.push_back(
            odometry::meanSteering_rad(samples[i - 1].steering_rad[w], samples[i].steering_rad[w]));
      steps.push_back(std::move(step));
    }
    steps_.push_back(std::move(steps));
    cut(r, window_s, margin_s);
  }
}

void WheelWindows::cut(std::size_t run, double window_s, double margin_s) {
  const auto& samples = runs_[run].samples;
  const Trajectory& reference = runs_[run].reference;
  const auto covered = [&](std::size_t i) {
    return eval::poseAt(reference, samples[i].time_s - margin_s) &&
           eval::poseAt(reference, samples[i].time_s + margin_s);
  };
  std::optional<std::size_t> first;
  std::size_t last = 0;
  const auto add = [&](double least_s) {
    if (!first || samples[last].time_s - samples[*first].time_s < least_s) return;
    const Window window{run, *first, last};
    if (moves(window)) windows_.push_back(window);
    first = last;
  };
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!covered(i)) continue;
    if (first && samples[i].time_s - samples[last].time_s > 0.5) {  // a hole in the reference
      add(0.5 * window_s);
      first.reset();
    }
    last = i;
    if (!first) first = i;
    add(window_s - 1e-3);
  }
  add(0.5 * window_s);
}

bool WheelWindows::moves(const Window& window) const {
  for (std::size_t i = window.first; i < window.last; ++i)
    for (const double pulses : steps_[window.run][i].pulses)
      if (pulses != 0.0) return true;
  return false;
}

odometry::WheelInterval WheelWindows::intervalOf(const Step& step, const kinematics::DriveParams& drive,
                                                 const odometry::WheelOdometryParams& errors) const {
  odometry::WheelInterval interval;
  interval.steering_rad = step.steering_rad;
  for (std::size_t w = 0; w < step.pulses.size(); ++w) {
    const double distance_m = step.pulses[w] * drive.wheels[w].metresPerPulse();
    interval.distance_m.push_back(distance_m);
    interval.variance_m2.push_back(errors.slipVariance_m2(distance_m) +
                                   2.0 * errors.readingVariance_m2(drive.wheels[w]));
  }
  return interval;
}

WheelWindows::Motion WheelWindows::byWheels(const Window& window, const kinematics::Drive& drive,
                                            const odometry::WheelOdometryParams& errors) const {
  const auto wheels = static_cast<Eigen::Index>(drive.size());
  Motion motion{Eigen::Isometry2d::Identity(), Eigen::VectorXd::Zero(2 * wheels)};
  Eigen::VectorXd variances = Eigen::VectorXd::Constant(2 * wheels, 1e-300);
  for (std::size_t i = window.first; i < window.last; ++i) {
    const odometry::WheelInterval interval = intervalOf(steps_[window.run][i], drive.params(), errors);
    const Eigen::Vector3d twist = odometry::solveInterval(drive, interval).motion;
    motion.T_start_end = motion.T_start_end * expPlanar(twist);
    for (Eigen::Index w = 0; w < wheels; ++w) {
      const auto wheel = static_cast<std::size_t>(w);
      const kinematics::WheelRows rows =
          drive.rows(wheel, interval.steering_rad.empty() ? 0.0 : interval.steering_rad[wheel]);
      motion.contradictions(w) += interval.distance_m[wheel] - rows.rolling * twist;
      if (rows.has_sideways) motion.contradictions(wheels + w) -= rows.sideways * twist;
      variances(w) += interval.variance_m2[wheel];
      variances(wheels + w) += interval.variance_m2[wheel];
    }
  }
  motion.contradictions = motion.contradictions.cwiseQuotient(variances.cwiseSqrt());
  return motion;
}

Eigen::Isometry2d WheelWindows::byReference(const Window& window, double offset_s) const {
  const WheelRun& run = runs_[window.run];
  const auto at = [&](std::size_t sample) {
    return planarPart(*eval::poseAt(run.reference, run.samples[sample].time_s + offset_s));
  };
  return at(window.first).inverse() * at(window.last);
}

Eigen::Matrix3d WheelWindows::covariance(const Window& window,
                                         const odometry::WheelOdometryParams& params) const {
  const kinematics::Drive drive(params.drive);
  odometry::PlanarCovariance covariance(drive.size(), params.scale_sigma);
  std::vector<double> reading_variance_m2;
  for (const auto& wheel : params.drive.wheels)
    reading_variance_m2.push_back(params.readingVariance_m2(wheel));
  for (std::size_t i = window.first; i < window.last; ++i) {
    odometry::WheelStep step;
    step.interval = intervalOf(steps_[window.run][i], params.drive, params);
    step.motion = odometry::solveInterval(drive, step.interval);
    for (const double distance_m : step.interval.distance_m)
      step.slip_variance_m2.push_back(params.slipVariance_m2(distance_m));
    covariance.append(step, reading_variance_m2);
  }
  return covariance.covariance();
}

}  // namespace stereo_nav::calibration
