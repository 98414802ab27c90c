#include "mapping/mono/one_point_ransac.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace stereo_nav::mapping {
namespace {

/// Which matches the state agrees with, when it is corrected by one of them alone.
std::vector<std::size_t> agreeing(const MonoState& state, const ImageModel& model,
                                  const std::vector<PixelMatch>& matches, std::size_t chosen,
                                  double threshold_px) {
  const PixelMatch& match = matches[chosen];
  const StateBlock& landmark = state.blocks[match.block];
  const auto PHt = covarianceWith(state, landmark, match.expected);
  // The hypothesis is what the match says, without the doubt of its second-order term.
  const Eigen::Matrix2d S = match.expected.by_camera * PHt.topRows<kCameraRows>() +
                            match.expected.by_landmark * PHt.middleRows(landmark.offset, landmark.rows()) +
                            model.pixel_sigma_px * model.pixel_sigma_px * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d weighted = S.ldlt().solve(match.innovation());
  CameraState camera = state.camera;
  const Eigen::Matrix<double, kCameraRows, 1> step = PHt.topRows<kCameraRows>() * weighted;
  camera.p_world += step.segment<3>(0);
  camera.q_world_camera = camera.q_world_camera * expQuaternion(step.segment<3>(3));
  camera.v_world += step.segment<3>(6);
  camera.omega_camera += step.segment<3>(9);
  std::vector<std::size_t> inliers;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const StateBlock& block = state.blocks[matches[i].block];
    StateBlock moved;
    moved.form = block.form;
    moved.value = block.value;
    moved.value.head(block.rows()) += PHt.middleRows(block.offset, block.rows()) * weighted;
    const auto px = pixelOf(model.camera, camera, moved, model.readout_s);
    if (px && (*px - matches[i].found_px).norm() < threshold_px) inliers.push_back(i);
  }
  return inliers;
}

}  // namespace

std::vector<std::size_t> lowInnovationInliers(const MonoState& state, const ImageModel& model,
                                              const std::vector<PixelMatch>& matches,
                                              const OnePointRansacParams& params, std::mt19937& random) {
  std::vector<std::size_t> order(matches.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  std::vector<std::size_t> best;
  double needed = std::min(static_cast<double>(params.most_hypotheses), static_cast<double>(matches.size()));
  for (std::size_t k = 0; static_cast<double>(k) < needed; ++k) {
    const std::vector<std::size_t> inliers = agreeing(state, model, matches, order[k], params.threshold_px);
    if (inliers.size() <= best.size()) continue;
    best = inliers;
    const double share = static_cast<double>(best.size()) / static_cast<double>(matches.size());
    if (share >= 1.0) break;
    needed = std::min(needed, std::ceil(std::log(1.0 - params.probability) / std::log(1.0 - share)));
  }
  return best;
}

std::vector<PixelMatch> highInnovationInliers(const MonoState& corrected, const ImageModel& model,
                                              const std::vector<PixelMatch>& matches,
                                              const OnePointRansacParams& params) {
  std::vector<PixelMatch> inliers;
  for (const PixelMatch& match : matches) {
    const Eigen::Matrix2d S =
        innovationCovariance(corrected, corrected.blocks[match.block], match.expected, model.pixel_sigma_px);
    if (match.innovation().dot(S.ldlt().solve(match.innovation())) < params.chi_square)
      inliers.push_back(match);
  }
  return inliers;
}

}  // namespace stereo_nav::mapping
