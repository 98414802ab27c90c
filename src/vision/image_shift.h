#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "vision/image_pyramid.h"

namespace stereo_nav::vision {

/// How far the picture as a whole has moved, in px of level 0: where the middle of `from` has the best
/// normalised correlation with `to`, on the coarsest level. It finds the features after turns that nothing
/// predicted. Nothing is returned if the two images look too little alike.
std::optional<cv::Point2f> coarseShift(const ImagePyramid& from, const ImagePyramid& to);

}  // namespace stereo_nav::vision
