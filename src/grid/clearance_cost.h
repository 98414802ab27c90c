#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>

#include "stereo_nav/core/parameter_visitor.h"

namespace stereo_nav::grid {

/// How much a way near obstacles counts as longer than it is. The clearance is that between the robot's
/// outline and the nearest obstacle.
struct ClearanceParams {
  double weight = 2.0;    ///< at no clearance a way counts 1 + this times its length
  double decay_m = 0.15;  ///< the extra cost falls to 1/e over this clearance

  void describe(ParameterVisitor& visitor);
};

/// Extra cost as a whole number of units of a way's length, for each clearance in cells: weight
/// exp(-clearance / decay).
class ClearanceCost {
 public:
  /// `units`: what an extra cost of once the length is as a number; costs are at most 255.
  ClearanceCost(const ClearanceParams& params, double resolution_m, std::uint32_t units);

  /// The clearance in cells from which on the cost is zero.
  int reach_cells() const { return reach_cells_; }
  std::uint8_t at(float clearance_cells) const {
    return table_[static_cast<std::size_t>(clearance_cells * kPerCell) < table_.size()
                      ? static_cast<std::size_t>(clearance_cells * kPerCell)
                      : table_.size() - 1];
  }
  /// Costs of a part of a grid, from a DistanceField of a CollisionMask: that distance is the clearance.
  void apply(const cv::Mat_<float>& distances, const cv::Rect& part, cv::Mat_<std::uint8_t>& costs) const;

 private:
  static constexpr int kPerCell = 8;
  static constexpr int kMostCells = 127;
  std::array<std::uint8_t, kPerCell*(kMostCells + 1)> table_{};
  int reach_cells_ = 0;
};

}  // namespace stereo_nav::grid
