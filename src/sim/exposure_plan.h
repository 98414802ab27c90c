#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/sensor_params.h"

namespace stereo_nav::sim {

/// Images that a camera with automatic exposure sees before the first one that counts: enough for the loop to
/// settle.
constexpr int kImagesBefore = 120;

/// Mean grey level, after the tone curve, that the camera sees in one of its images when it takes it so.
using ExposureMeter = std::function<double(std::size_t image, const ExposureSetting& setting)>;

/// With what each of a camera's images is taken: always the same, or as the automatic exposure goes from
/// image to image. The camera has looked at the first image for a while before. Known beforehand, so that
/// images can be rendered in any order and on any number of threads.
std::vector<ExposureSetting> planExposures(const SensorParams& sensor, std::size_t images,
                                           const ExposureMeter& meter);

/// Factor from the light to the signal for an exposure time.
double signalPerLight(const SensorParams& sensor, double exposure_ms);

/// Mean of a signal times `gain` after the tone curve; the middle of the image counts more than the corners.
double meteredGrey(const cv::Mat& signal, double gain, const ImageProcessing& processing);

}  // namespace stereo_nav::sim
