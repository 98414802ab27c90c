#pragma once

#include <string>
#include <vector>

#include "kinematics/drive.h"
#include "odometry/wheel/interval_motion.h"

namespace stereo_nav::odometry {

/// Finds the encoder that counts backwards, the two that are swapped, or the one that is dead, by what
/// contradicts the other wheels and the IMU's yaw. Needs redundancy: more wheels than unknowns, or an IMU. A
/// fault that leaves the equations intact cannot be seen: two wheels swapped in a symmetrical drive of three
/// are the mirror image of it.
class EncoderCheck {
 public:
  explicit EncoderCheck(const kinematics::Drive& drive);

  /// Adds an interval; intervals are summed up to windows of a quarter second, in which motion is judged.
  void add(const WheelInterval& interval, double duration_s);

  /// Empty while all is well or undecided; else what was seen, the likely cause and the remedy.
  const std::string& finding() const { return finding_; }

 private:
  struct Hypothesis {
    enum class Kind { kAsGiven, kReversed, kSwapped, kDead } kind;
    std::size_t wheel;
    std::size_t other;
    double squares = 0.0;  ///< normalised squared residuals of all windows
    bool possible = true;
  };

  void judgeWindow();
  void restartWindow();
  void decide();
  double squaresUnder(Hypothesis& hypothesis) const;
  std::string describe(const Hypothesis& hypothesis) const;

  const kinematics::Drive& drive_;
  std::vector<Hypothesis> hypotheses_;
  WheelInterval window_;                     ///< sums; its steering angles are those of its start
  std::vector<double> steering_turn_rad_s_;  ///< integral of the angles since then
  double duration_s_ = 0.0;
  int windows_ = 0;
  std::string finding_;
};

}  // namespace stereo_nav::odometry
