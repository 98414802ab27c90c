#pragma once

#include <opencv2/core.hpp>
#include <random>

namespace stereo_nav::grid {

/// A grid of which the given share is obstacles, the same for the same seed.
inline cv::Mat_<std::uint8_t> randomObstacles(int width, int height, double share, unsigned seed) {
  std::mt19937 generator(seed);
  std::bernoulli_distribution is_obstacle(share);
  cv::Mat_<std::uint8_t> obstacles(height, width);
  for (auto& cell : obstacles) cell = is_obstacle(generator) ? 1 : 0;
  return obstacles;
}

}  // namespace stereo_nav::grid
