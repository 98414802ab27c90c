#include "odometry/wheel/encoder_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/angles.h"

namespace stereo_nav::odometry {
namespace {

constexpr double kWindow_s = 0.25;
constexpr double kMostSteering_rad = 0.3;  // within a window, whose mean angle then stands for all of it
constexpr double kLeastPulses = 30.0;      // that the fastest wheel moves in a window worth judging
constexpr int kLeastWindows = 12;
constexpr int kMostWindows = 240;  // a minute; then the sums start anew, so that a late fault is found, too
constexpr double kTolerance =
    0.1;  // of the fastest wheel's way: slip and wrong radii are no fault of an encoder
constexpr double kYawTolerance = 0.05;  // of the yaw increment
constexpr double kYawFloor_rad = 0.01;
constexpr double kContradiction = 3.0;  // mean square per window above which something is wrong
constexpr double kMuchBetter = 8.0;     // factor between the fault found and the next likely one

}  // namespace

EncoderCheck::EncoderCheck(const kinematics::Drive& drive) : drive_(drive) {
  using Kind = Hypothesis::Kind;
  hypotheses_.push_back({Kind::kAsGiven, 0, 0});
  for (std::size_t i = 0; i < drive.size(); ++i) {
    hypotheses_.push_back({Kind::kReversed, i, i});
    hypotheses_.push_back({Kind::kDead, i, i});
    for (std::size_t j = 0; j < i; ++j) hypotheses_.push_back({Kind::kSwapped, j, i});
  }
  window_.distance_m.assign(drive.size(), 0.0);
}

void EncoderCheck::add(const WheelInterval& interval, double duration_s) {
  if (!finding_.empty()) return;
  for (std::size_t i = 0; i < interval.steering_rad.size() && duration_s_ > 0.0; ++i) {
    if (std::abs(wrapRadians(interval.steering_rad[i] - window_.steering_rad[i])) < kMostSteering_rad)
      continue;
    restartWindow();
    break;
  }
  if (duration_s_ == 0.0) {
    window_.steering_rad = interval.steering_rad;
    steering_turn_rad_s_.assign(interval.steering_rad.size(), 0.0);
  }
  for (std::size_t i = 0; i < drive_.size(); ++i) window_.distance_m[i] += interval.distance_m[i];
  for (std::size_t i = 0; i < interval.steering_rad.size(); ++i)
    steering_turn_rad_s_[i] += duration_s * wrapRadians(interval.steering_rad[i] - window_.steering_rad[i]);
  if (interval.yaw_rad) window_.yaw_rad = window_.yaw_rad.value_or(0.0) + *interval.yaw_rad;
  duration_s_ += duration_s;
  if (duration_s_ < kWindow_s) return;
  for (std::size_t i = 0; i < window_.steering_rad.size(); ++i)
    window_.steering_rad[i] += steering_turn_rad_s_[i] / duration_s_;
  judgeWindow();
  restartWindow();
}

void EncoderCheck::restartWindow() {
  std::fill(window_.distance_m.begin(), window_.distance_m.end(), 0.0);
  window_.yaw_rad.reset();
  duration_s_ = 0.0;
}

void EncoderCheck::judgeWindow() {
  double fastest_m = 0.0;
  double pulse_m = 0.0;
  for (std::size_t i = 0; i < drive_.size(); ++i) {
    fastest_m = std::max(fastest_m, std::abs(window_.distance_m[i]));
    pulse_m = std::max(pulse_m, std::abs(drive_.params().wheels[i].metresPerPulse()));
  }
  if (fastest_m < kLeastPulses * pulse_m) return;
  const double sigma_m = kTolerance * fastest_m;
  window_.variance_m2.assign(drive_.size(), sigma_m * sigma_m);
  const double yaw_sigma = kYawTolerance * std::abs(window_.yaw_rad.value_or(0.0)) + kYawFloor_rad;
  window_.yaw_variance_rad2 = yaw_sigma * yaw_sigma;
  if (solveInterval(drive_, window_).redundancy < 1) return;
  for (auto& hypothesis : hypotheses_)
    if (hypothesis.possible) hypothesis.squares += squaresUnder(hypothesis);
  ++windows_;
  if (windows_ >= kLeastWindows) decide();
  if (windows_ < kMostWindows) return;
  windows_ = 0;
  for (auto& hypothesis : hypotheses_) {
    hypothesis.squares = 0.0;
    hypothesis.possible = true;
  }
}

double EncoderCheck::squaresUnder(Hypothesis& hypothesis) const {
  WheelInterval supposed = window_;
  switch (hypothesis.kind) {
    case Hypothesis::Kind::kAsGiven:
      break;
    case Hypothesis::Kind::kReversed:
      supposed.distance_m[hypothesis.wheel] *= -1.0;
      break;
    case Hypothesis::Kind::kSwapped: {
      // Pulses are swapped, not metres: the wheels may differ in radius and in resolution.
      const auto& wheels = drive_.params().wheels;
      const double ratio =
          wheels[hypothesis.wheel].metresPerPulse() / wheels[hypothesis.other].metresPerPulse();
      const double first_m = window_.distance_m[hypothesis.wheel];
      supposed.distance_m[hypothesis.wheel] = window_.distance_m[hypothesis.other] * ratio;
      supposed.distance_m[hypothesis.other] = first_m / ratio;
      break;
    }
    case Hypothesis::Kind::kDead:
      hypothesis.possible = window_.distance_m[hypothesis.wheel] == 0.0;
      supposed.variance_m2[hypothesis.wheel] = std::numeric_limits<double>::infinity();
      break;
  }
  return solveInterval(drive_, supposed).squared_residual;
}

void EncoderCheck::decide() {
  const Hypothesis& as_given = hypotheses_.front();
  if (as_given.squares < kContradiction * windows_) return;
  const Hypothesis* best = nullptr;
  double second = std::numeric_limits<double>::infinity();
  for (const auto& hypothesis : hypotheses_) {
    if (!hypothesis.possible) continue;
    // An encoder that never moved is dead before it is anything else: reversing or swapping zeros explains
    // little.
    if (hypothesis.kind == Hypothesis::Kind::kDead && hypothesis.squares * kMuchBetter < as_given.squares) {
      finding_ = describe(hypothesis);
      return;
    }
    if (best == nullptr || hypothesis.squares < best->squares) {
      if (best != nullptr) second = best->squares;
      best = &hypothesis;
    } else {
      second = std::min(second, hypothesis.squares);
    }
  }
  if (best != &as_given && best->squares * kMuchBetter < second) finding_ = describe(*best);
}

std::string EncoderCheck::describe(const Hypothesis& hypothesis) const {
  const auto named = [this](std::size_t wheel) {
    return "wheel_" + std::to_string(wheel + 1) + " (" + drive_.params().wheels[wheel].name + ")";
  };
  const std::string seen = "the pulses of the wheels contradict each other or the IMU's yaw: ";
  if (hypothesis.kind == Hypothesis::Kind::kReversed) {
    return seen + "the encoder of " + named(hypothesis.wheel) +
           " counts backwards; change its encoder_reversed";
  }
  if (hypothesis.kind == Hypothesis::Kind::kSwapped) {
    return seen + "the encoders of " + named(hypothesis.wheel) + " and " + named(hypothesis.other) +
           " are swapped; swap their plugs";
  }
  return seen + "the encoder of " + named(hypothesis.wheel) +
         " gives no pulses; check its plug and its supply";
}

}  // namespace stereo_nav::odometry
