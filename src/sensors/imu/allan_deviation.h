#pragma once

#include <vector>

namespace stereo_nav::imu {

/// Deviation at one averaging time.
struct AllanPoint {
  double tau_s;
  double deviation;  ///< in the unit of the samples
};

/// Overlapping Allan deviation of evenly spaced samples of a rate (IEEE Std 952-1997, annex C), at averaging
/// times that grow by about a quarter octave, up to a ninth of the recording. White noise of density N shows
/// as N / sqrt(tau), a bias instability as the flat part, a random walk K of the bias as K sqrt(tau / 3).
std::vector<AllanPoint> allanDeviation(const std::vector<double>& samples, double period_s);

/// White noise density: the deviation at 1 s read off the slope -1/2, from the times up to 1 s. NaN if there
/// are none.
double noiseDensity(const std::vector<AllanPoint>& points);

/// The smallest deviation, divided by 0.664: the bias instability. NaN without points.
double biasInstability(const std::vector<AllanPoint>& points);

}  // namespace stereo_nav::imu
