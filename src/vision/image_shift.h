#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "vision/image_pyramid.h"

namespace stereo_nav::vision {

/// How far the picture as a whole has moved, px of level 0: the place of the middle of `from` in `to` with
/// the best normalised correlation, on the coarsest level. For turns that nothing predicted; nothing if the
/// two look too little alike.
std::optional<cv::Point2f> coarseShift(const ImagePyramid& from, const ImagePyramid& to);

}  // namespace stereo_nav::vision
