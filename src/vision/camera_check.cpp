#include "vision/camera_check.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/angles.h"
#include "stereo_nav/core/input_error.h"

namespace stereo_nav::vision {
namespace {

constexpr const char* kAgain = "; calibrate the pair again";

std::string numberText(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw InputError(name + ": " + what);
}

bool allFinite(const double* numbers, std::size_t count) {
  return std::all_of(numbers, numbers + count, [](double value) { return std::isfinite(value); });
}

void checkFinite(const std::string& name, const CameraFields& camera) {
  if (allFinite(camera.K.val, 9) && allFinite(camera.R.val, 9) && allFinite(camera.P.val, 12) &&
      allFinite(camera.D.data(), camera.D.size())) {
    return;
  }
  refuse(name, std::string("holds a NaN or an infinity") + kAgain);
}

void checkSize(const std::string& name, const cv::Size& size) {
  constexpr int kLargest_px = 16384;
  if (size.width > 0 && size.height > 0 && size.width <= kLargest_px && size.height <= kLargest_px) return;
  refuse(name, "its image size is " + sizeText(size) +
                   "; width and height must be those of the images that were calibrated");
}

/// R may be left out (all 0) where there is nothing to turn; normaliseLens() decides that.
void checkRotation(const std::string& name, const CameraFields& camera) {
  constexpr double kRounding = 1e-3;
  const bool left_out = cv::norm(camera.R) == 0.0;
  const bool rotation =
      cv::norm(camera.R * camera.R.t() - cv::Matx33d::eye()) < kRounding && cv::determinant(camera.R) > 0.0;
  if (left_out || rotation) return;
  refuse(name, "R is no rotation (its rows must have length 1 and stand at right angles)" +
                   std::string(kAgain) + " and take R from the calibration as it is");
}

/// An entry that has a fixed value in every calibration.
void checkEntry(const std::string& name, const std::string& entry, double value, double expected,
                double tolerance, const std::string& meaning) {
  if (std::abs(value - expected) <= tolerance) return;
  refuse(name, entry + " is " + numberText(value) + " and must be " + numberText(expected) + ": " + meaning +
                   kAgain);
}

void checkEntries(const std::string& name, const CameraFields& camera) {
  constexpr double kSheared_px = 1e-3, kRounding = 1e-9;
  const std::string shear = "sheared pixels are not supported";
  const std::string last_row = "the last row of the matrix is fixed";
  const cv::Matx33d& K = camera.K;
  const cv::Matx34d& P = camera.P;
  checkEntry(name, "K[1]", K(0, 1), 0.0, kSheared_px, shear);
  checkEntry(name, "K[3]", K(1, 0), 0.0, kSheared_px, shear);
  checkEntry(name, "P[1]", P(0, 1), 0.0, kSheared_px, shear);
  checkEntry(name, "P[4]", P(1, 0), 0.0, kSheared_px, shear);
  checkEntry(name, "P[7]", P(1, 3), 0.0, kSheared_px,
             "the cameras of a pair lie side by side, P[3] holds their distance");
  checkEntry(name, "P[11]", P(2, 3), 0.0, kRounding, "it would be a distance along the optical axis");
  for (int column = 0; column < 3; ++column) {
    const double expected = column == 2 ? 1.0 : 0.0;
    checkEntry(name, "K[" + std::to_string(6 + column) + "]", K(2, column), expected, kRounding, last_row);
    checkEntry(name, "P[" + std::to_string(8 + column) + "]", P(2, column), expected, kRounding, last_row);
  }
}

/// `focal_length_px` sees `size_px` in an angle that lenses have.
void checkView(const std::string& name, const std::string& entry, double focal_length_px, int size_px) {
  constexpr double kNarrowest_deg = 3.0, kWidest_deg = 165.0;
  const double angle_deg = 2.0 * std::atan2(0.5 * size_px, focal_length_px) * kDegPerRad;
  if (focal_length_px > 0.0 && angle_deg > kNarrowest_deg && angle_deg < kWidest_deg) return;
  refuse(name, "the focal length " + entry + " is " + numberText(focal_length_px) + " px, with which " +
                   std::to_string(size_px) + " px would span " + numberText(angle_deg) +
                   " degrees; it must be in px of this image size, not in mm or of another size" + kAgain);
}

void checkFocalLengths(const std::string& name, const std::string& matrix, double fx, double fy,
                       const cv::Size& size) {
  checkView(name, matrix + "[0]", fx, size.width);
  checkView(name, matrix + (matrix == "K" ? "[4]" : "[5]"), fy, size.height);
  constexpr double kOblong = 2.0;
  if (fx / fy < kOblong && fy / fx < kOblong) return;
  refuse(name, "the focal lengths of " + matrix + " are " + numberText(fx) + " and " + numberText(fy) +
                   " px, as with pixels that are more than twice as long as high" + kAgain);
}

void checkPrincipalPoint(const std::string& name, const std::string& matrix, double cx, double cy,
                         const cv::Size& size, double margin) {
  const auto lies_in = [margin](double centre, int extent) {
    return centre >= -margin * extent && centre <= (1.0 + margin) * extent;
  };
  if (lies_in(cx, size.width) && lies_in(cy, size.height)) return;
  refuse(name, "the principal point of " + matrix + ", (" + numberText(cx) + ", " + numberText(cy) +
                   "), lies outside the image of " + sizeText(size) +
                   "; is the calibration of another image size?");
}

}  // namespace

void checkMatrices(const std::string& name, const CameraFields& camera) {
  checkFinite(name, camera);
  if (camera.K(0, 0) == 0.0 || camera.P(0, 0) == 0.0) {
    refuse(name, "the camera is not calibrated (K or P is zero); was the calibration file found?");
  }
  checkSize(name, camera.size);
  checkRotation(name, camera);
  checkEntries(name, camera);
  checkFocalLengths(name, "K", camera.K(0, 0), camera.K(1, 1), camera.size);
  checkFocalLengths(name, "P", camera.P(0, 0), camera.P(1, 1), camera.size);
  checkPrincipalPoint(name, "K", camera.K(0, 2), camera.K(1, 2), camera.size, 0.0);
  // Rectifying cameras that squint moves the point; it may leave the image.
  checkPrincipalPoint(name, "P", camera.P(0, 2), camera.P(1, 2), camera.size, 1.0);
}

void applyWindow(const std::string& name, CameraFields& camera) {
  cv::Rect roi = camera.roi;
  if (roi == cv::Rect()) roi = cv::Rect(cv::Point(), camera.size);
  const cv::Size binning(std::max(camera.binning.width, 1), std::max(camera.binning.height, 1));
  const std::string calibrated = sizeText(camera.size);
  if (roi.x < 0 || roi.y < 0 || roi.width <= 0 || roi.height <= 0 || roi.width > camera.size.width - roi.x ||
      roi.height > camera.size.height - roi.y) {
    std::ostringstream text;
    text
        << "roi (x_offset " << roi.x << ", y_offset " << roi.y << ", " << sizeText(roi.size())
        << ") does not lie in the image of " << calibrated
        << "; width and height must be those of the image that was calibrated, before it was cropped, or roi "
           "must be 0 where the cropped image was calibrated";
    refuse(name, text.str());
  }
  const cv::Size delivered(roi.width / binning.width, roi.height / binning.height);
  if (delivered.width == 0 || delivered.height == 0) {
    refuse(name, "binning of " + sizeText(binning) + " leaves nothing of the image of " + calibrated +
                     "; set it to what the camera does");
  }
  camera.roi = cv::Rect();
  camera.binning = cv::Size();
  if (delivered == camera.size) return;
  camera.size = delivered;
  // A binned pixel is the mean of its block, so that its centre is that of the block.
  const auto delivered_x = [&](double x) { return (x - roi.x + 0.5) / binning.width - 0.5; };
  const auto delivered_y = [&](double y) { return (y - roi.y + 0.5) / binning.height - 0.5; };
  camera.K(0, 0) /= binning.width;
  camera.K(0, 2) = delivered_x(camera.K(0, 2));
  camera.K(1, 1) /= binning.height;
  camera.K(1, 2) = delivered_y(camera.K(1, 2));
  camera.P(0, 0) /= binning.width;
  camera.P(0, 2) = delivered_x(camera.P(0, 2));
  camera.P(0, 3) /= binning.width;
  camera.P(1, 1) /= binning.height;
  camera.P(1, 2) = delivered_y(camera.P(1, 2));
}

}  // namespace stereo_nav::vision
