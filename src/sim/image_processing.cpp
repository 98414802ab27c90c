#include "sim/image_processing.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace stereo_nav::sim {
namespace {

constexpr int kCurveSteps = 4096;
/// Below this share of full scale the tone curve is a straight line to black: a power's slope there is
/// infinite, and cameras avoid that.
constexpr double kToe = 0.004;
/// Qualities between which webcams change with the content, and how often the search looks.
constexpr int kWorstQuality = 35, kBestQuality = 92, kFirstQuality = 75, kTrials = 4;
/// A size is good enough within this share of the one asked for.
constexpr double kSizeTolerance = 0.1;

double toneOf(double share, double gamma) {
  if (share <= kToe) return share / kToe * std::pow(kToe, 1.0 / gamma);
  return std::pow(share, 1.0 / gamma);
}

cv::Mat roundedAndClipped(const cv::Mat& signal) {
  cv::Mat image(signal.size(), CV_8UC1);
  for (int y = 0; y < signal.rows; ++y) {
    const float* in = signal.ptr<float>(y);
    uchar* out = image.ptr<uchar>(y);
    for (int x = 0; x < signal.cols; ++x) out[x] = static_cast<uchar>(std::clamp(in[x] + 0.5f, 0.0f, 255.0f));
  }
  return image;
}

std::vector<uchar> encode(const cv::Mat& image, int quality) {
  std::vector<uchar> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return bytes;
}

}  // namespace

ImageProcessing::ImageProcessing(const ProcessingParams& params) : params_(params) {
  for (int step = 0; step <= kCurveSteps; ++step) {
    curve_.push_back(
        static_cast<float>(255.0 * toneOf(static_cast<double>(step) / kCurveSteps, params.gamma)));
  }
  curve_.push_back(curve_.back());  // what lies beside the last one when that is asked for
}

float ImageProcessing::tone(float signal) const {
  const float at = std::clamp(signal, 0.0f, 255.0f) * (static_cast<float>(kCurveSteps) / 255.0f);
  const auto step = static_cast<std::size_t>(at);
  const float share = at - static_cast<float>(step);
  return curve_[step] + share * (curve_[step + 1] - curve_[step]);
}

void ImageProcessing::sharpen(cv::Mat& image) const {
  if (params_.sharpening == 0.0) return;
  cv::Mat blurred;
  cv::GaussianBlur(image, blurred, cv::Size(), params_.sharpening_px);
  cv::addWeighted(image, 1.0 + params_.sharpening, blurred, -params_.sharpening, 0.0, image);
}

CompressedImage ImageProcessing::compress(const cv::Mat& image) const {
  const double wanted = 1e3 * params_.jpeg_kb * static_cast<double>(image.total()) / (640.0 * 480.0);
  int worst = kWorstQuality, best = kBestQuality;
  CompressedImage result;
  result.quality = kFirstQuality;
  for (int trial = 0;; ++trial) {
    result.bytes = encode(image, result.quality);
    const double ratio = static_cast<double>(result.bytes.size()) / wanted;
    if (std::fabs(ratio - 1.0) <= kSizeTolerance || trial + 1 == kTrials) return result;
    (ratio > 1.0 ? best : worst) = result.quality;
    const int next = (worst + best) / 2;
    if (next == result.quality) return result;
    result.quality = next;
  }
}

cv::Mat ImageProcessing::develop(const cv::Mat& signal) const {
  if (params_.linear()) return roundedAndClipped(signal);
  cv::Mat grey(signal.size(), CV_32FC1);
  for (int y = 0; y < signal.rows; ++y) {
    const float* in = signal.ptr<float>(y);
    float* out = grey.ptr<float>(y);
    for (int x = 0; x < signal.cols; ++x) out[x] = tone(in[x]);
  }
  sharpen(grey);
  const cv::Mat image = roundedAndClipped(grey);
  if (params_.jpeg_kb == 0.0) return image;
  return cv::imdecode(compress(image).bytes, cv::IMREAD_GRAYSCALE);
}

void ProcessingParams::describe(ParameterVisitor& visitor) {
  visitor.real("gamma", gamma, {0.5, 5.0}, "", "grey = light^(1/gamma): the tone curve; 1 is linear");
  visitor.real("sharpening", sharpening, {0.0, 5.0}, "",
               "strength of the unsharp mask, which puts halos around edges; 0 is none");
  visitor.real("sharpening_px", sharpening_px, {0.2, 10.0}, "px", "width of the halos");
  visitor.real("jpeg_kb", jpeg_kb, {0.0, 10000.0}, "kB",
               "an image of 640x480 is compressed to this (1000 bytes), others in proportion; 0: not at all");
}

}  // namespace stereo_nav::sim
