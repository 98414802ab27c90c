#include "navigation/navigator/recovery.h"

namespace stereo_nav::navigator {

void RecoveryParams::describe(ParameterVisitor& visitor) {
  visitor.integer("most_rounds", most_rounds, {0, 20}, "",
                  "how often it clears, backs off and turns before it gives up");
  visitor.real("back_off_m", back_off_m, {0.05, 5.0}, "m", "way back");
  visitor.real("back_off_speed_m_per_s", back_off_speed_m_per_s, {0.02, 2.0}, "m/s", "speed on the way back");
  visitor.real("turn_rate_rad_per_s", turn_rate_rad_per_s, {0.1, 5.0}, "rad/s", "rate of the turn");
  visitor.real("most_step_s", most_step_s, {1.0, 60.0}, "s", "a step that takes longer is over");
  visitor.real("forget_after_m", forget_after_m, {0.1, 100.0}, "m",
               "way after which the rounds count from zero");
}

Recovery::Recovery(const RecoveryParams& params, bool can_turn)
    : round_{RecoveryStep::kClear, RecoveryStep::kBackOff} {
  if (can_turn) round_.push_back(RecoveryStep::kTurn);
  most_ = round_.size() * static_cast<std::size_t>(params.most_rounds);
}

std::optional<RecoveryStep> Recovery::next() {
  if (taken_ >= most_) return std::nullopt;
  return round_[taken_++ % round_.size()];
}

std::string Recovery::tried() const {
  if (taken_ == 0) return "";
  const std::string times = std::to_string((taken_ + round_.size() - 1) / round_.size()) + " times";
  return std::string("obstacles were cleared, the way back and ") +
         (round_.size() > 2 ? "a turn were tried " : "a new plan were tried ") + times;
}

}  // namespace stereo_nav::navigator
