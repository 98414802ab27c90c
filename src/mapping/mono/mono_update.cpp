#include "mapping/mono/mono_update.h"

namespace stereo_nav::mapping {

bool correctByPixels(MonoState& state, const std::vector<PixelMatch>& matches, double pixel_sigma_px) {
  if (matches.empty()) return true;
  const auto rows = static_cast<Eigen::Index>(2 * matches.size());
  Eigen::MatrixXd PHt(state.covariance.size(), rows);
  Eigen::VectorXd innovation(rows);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    PHt.middleCols<2>(row) = covarianceWith(state, state.blocks[matches[i].block], matches[i].expected);
    innovation.segment<2>(row) = matches[i].innovation();
  }
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(rows, rows);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const StateBlock& landmark = state.blocks[matches[i].block];
    const auto row = static_cast<Eigen::Index>(2 * i);
    S.block<2, 2>(row, row) = pixelNoise(state, landmark, matches[i].expected, pixel_sigma_px);
    auto two_rows = S.middleRows<2>(row);
    two_rows += matches[i].expected.by_camera * PHt.topRows<kCameraRows>();
    two_rows += matches[i].expected.by_landmark * PHt.middleRows(landmark.offset, landmark.rows());
  }
  const Eigen::VectorXd step = state.covariance.update(PHt, S, innovation);
  state.correct(step);
  return step.size() != 0;
}

}  // namespace stereo_nav::mapping
