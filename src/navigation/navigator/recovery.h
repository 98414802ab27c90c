#pragma once

#include <optional>
#include <string>
#include <vector>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::navigator {

/// What a base tries when it does not get on.
enum class RecoveryStep {
  kClear,    ///< forgets the obstacles that are not seen any more
  kBackOff,  ///< drives back along the way that it came
  kTurn,     ///< turns once, so that its cameras see all around
};

/// How much is tried.
struct RecoveryParams {
  int most_rounds = 2;
  double back_off_m = 0.5;
  double back_off_speed_m_per_s = 0.2;
  double turn_rate_rad_per_s = 1.0;
  double most_step_s = 10.0;    ///< a step that takes longer is over
  double forget_after_m = 1.0;  ///< of way after which the rounds count from zero

  void describe(ParameterVisitor& visitor);
};

/// The order of the steps, and their bound: clear, back off, turn, and that as often as there are rounds.
/// Nobody drives to and fro for ever.
class Recovery {
 public:
  /// `can_turn`: false for a car, whose rounds leave the turn out.
  Recovery(const RecoveryParams& params, bool can_turn);

  /// The next step; nothing when all rounds are spent.
  std::optional<RecoveryStep> next();
  /// The base got on, or there is a new goal: rounds count from zero.
  void reset() { taken_ = 0; }
  /// What was tried, in words; empty if nothing.
  std::string tried() const;

 private:
  std::vector<RecoveryStep> round_;
  std::size_t most_;
  std::size_t taken_ = 0;
};

}  // namespace stereo_nav::navigator
