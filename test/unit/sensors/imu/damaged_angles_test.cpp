// The angle protocol over damaged lines, a million frames each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/angles.h"
#include "sensors/imu/emulation/emulated_module.h"
#include "sensors/imu/frame_decoder.h"
#include "sensors/serial/emulation/serial_line.h"
#include "unit/sensors/imu/module_stream.h"

namespace stereo_nav::imu {
namespace {

/// What the robot does while the line is damaged.
ModuleAngles swinging(double t) {
  return {170.0 * std::sin(0.35 * t), 8.0 * std::sin(1.1 * t), 5.0 * std::sin(1.7 * t)};
}

/// Up to 350 deg/s and 1250 deg/s^2, near what the gate's parameters allow; the yaw passes the wrap.
ModuleAngles shaken(double t) {
  return {wrapDegrees(180.0 + 150.0 * std::sin(2.0 * t) + 8.0 * std::sin(9.0 * t)), 20.0 * std::sin(7.0 * t),
          25.0 * std::sin(6.0 * t + 0.5)};
}

struct Damage {
  double corrupt, lost;  ///< shares of the bytes
  ModuleAngles (*motion)(double time_s);
  unsigned seed;
};

struct Outcome {
  std::size_t intact = 0, intact_delivered = 0, published = 0, off = 0;
  double worst_deg = 0.0;
};

/// A million frames of a module with noise over a damaged line.
Outcome passDamaged(const Damage& damage) {
  constexpr int kFrames = 1000000;
  ModuleErrors errors;
  errors.angle_noise_deg = 0.02;
  EmulatedModule module(Protocol::kAngles, AngleOrder::kYawPitchRoll, false, errors, 11);
  serial::LineFaults faults(damage.corrupt, damage.lost, damage.seed);
  const auto decoder = makeAngleDecoder(AngleOrder::kYawPitchRoll, AngleGateParams(), kBaud);
  struct Sent {
    ModuleAngles angles;
    bool intact;
    bool delivered;
  };
  std::vector<Sent> sent;
  Outcome outcome;
  const auto check = [&](const DecodedFrame& frame) {
    ++outcome.published;
    // A frame is complete with the last byte of its own piece, or, when it lost some, with the first of the
    // next one.
    const auto piece = static_cast<std::size_t>(std::lround(frame.arrival_s / kPeriod_s));
    const auto errorAgainst = [&](const Sent& of) {
      return (frame.angles->vector() - of.angles.vector()).unaryExpr(&wrapDegrees).lpNorm<Eigen::Infinity>();
    };
    Sent& claimed = sent.at(piece);
    const double error_deg =
        claimed.intact
            ? errorAgainst(claimed)
            : std::min(errorAgainst(claimed), errorAgainst(sent[std::max<std::size_t>(piece, 1) - 1]));
    claimed.delivered = true;
    if (error_deg > 0.3) ++outcome.off;
    outcome.worst_deg = std::max(outcome.worst_deg, error_deg);
  };
  std::vector<std::uint8_t> line;
  for (int k = 0; k < kFrames; ++k) {
    const double t = kPeriod_s * k;
    const std::vector<std::uint8_t> frame =
        module.frame({orientationFromModule(damage.motion(t)), {}, {}}, t);
    line.clear();
    const bool intact = faults.pass(frame.data(), frame.size(), line);
    sent.push_back({module.lastAngles(), intact, false});
    decoder->push(line.data(), line.size(), t, check);
  }
  for (const Sent& frame : sent) {
    outcome.intact += frame.intact;
    outcome.intact_delivered += frame.intact && frame.delivered;
  }
  return outcome;
}

class DamagedAngleStream : public testing::TestWithParam<Damage> {};

TEST_P(DamagedAngleStream, DeliversIntactFramesAndNothingFarOff) {
  const Damage& damage = GetParam();
  const Outcome outcome = passDamaged(damage);
  const double delivered_share =
      static_cast<double>(outcome.intact_delivered) / static_cast<double>(outcome.intact);
  const double off_share = static_cast<double>(outcome.off) / static_cast<double>(outcome.published);
  std::printf(
      "%s, seed %u, corrupt %.3f lost %.3f: intact frames delivered %.2f %%, off by > 0.3 deg %.4f %%, worst "
      "%.3f deg\n",
      damage.motion == &swinging ? "swinging" : "shaken", damage.seed, damage.corrupt, damage.lost,
      100 * delivered_share, 100 * off_share, outcome.worst_deg);
  EXPECT_GE(delivered_share, 0.90);
  EXPECT_LE(off_share, 0.001);
  EXPECT_LE(outcome.worst_deg, 3.0);
}

std::vector<Damage> damages() {
  std::vector<Damage> all;
  for (const auto motion : {&swinging, &shaken}) {
    for (const unsigned seed : {2u, 9u}) {
      all.push_back({0.01, 0.0, motion, seed});
      all.push_back({0.0, 0.01, motion, seed});
      all.push_back({0.005, 0.005, motion, seed});
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(OnePercent, DamagedAngleStream, testing::ValuesIn(damages()));

}  // namespace
}  // namespace stereo_nav::imu
