#include "grid/clearance_cost.h"

#include <algorithm>
#include <cmath>

namespace stereo_nav::grid {

void ClearanceParams::describe(ParameterVisitor& visitor) {
  visitor.real("weight", weight, {0.0, 7.0}, "",
               "a way that touches obstacles counts 1 + this times its length");
  visitor.real(
      "decay_m", decay_m, {0.01, 5.0}, "m",
      "the extra cost falls to 1/e over this clearance between the robot's outline and the nearest obstacle");
}

ClearanceCost::ClearanceCost(const ClearanceParams& params, double resolution_m, std::uint32_t units) {
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const double clearance_m = static_cast<double>(i) / kPerCell * resolution_m;
    const double cost = std::round(units * params.weight * std::exp(-clearance_m / params.decay_m));
    table_[i] = static_cast<std::uint8_t>(std::min(cost, 255.0));
    if (table_[i] > 0) reach_cells_ = static_cast<int>(i) / kPerCell + 1;
  }
  reach_cells_ = std::clamp(reach_cells_, 1, kMostCells);
  table_.back() = 0;
}

void ClearanceCost::apply(const cv::Mat_<float>& distances, const cv::Rect& part,
                          cv::Mat_<std::uint8_t>& costs) const {
  for (int y = part.y; y < part.br().y; ++y) {
    const float* distance = distances[y];
    std::uint8_t* cost = costs[y];
    for (int x = part.x; x < part.br().x; ++x) cost[x] = at(distance[x]);
  }
}

}  // namespace stereo_nav::grid
