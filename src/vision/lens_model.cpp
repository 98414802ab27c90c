#include "vision/lens_model.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <opencv2/calib3d.hpp>
#include <set>

#include "stereo_nav/core/input_error.h"

namespace stereo_nav::vision {
namespace {

constexpr const char* kPlumbBob = "plumb_bob";
constexpr const char* kRationalPolynomial = "rational_polynomial";
constexpr const char* kEquidistant = "equidistant";

const std::map<std::string, std::set<std::size_t>>& coefficientCounts() {
  static const std::map<std::string, std::set<std::size_t>> counts = {
      {kPlumbBob, {4, 5}}, {kRationalPolynomial, {8, 12, 14}}, {kEquidistant, {4}}};
  return counts;
}

/// Letters and digits alone, in lower case: "Brown Conrady" becomes "brownconrady".
std::string plain(const std::string& model) {
  std::string text;
  for (const char c : model) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) != 0) text += static_cast<char>(std::tolower(letter));
  }
  return text;
}

/// Names that drivers give to a pinhole image. Without coefficients they all say: nothing to correct.
bool isPinholeName(const std::string& model) {
  static const std::set<std::string> names = {
      "",       "none",   "nodistortion", "pinhole",         "perspective",         "rectified",
      "radtan", "opencv", "brownconrady", "plumbbob",        "inversebrownconrady", "modifiedbrownconrady",
      "brown",  "radial", "polynomial",   "radialtangential"};
  return names.count(plain(model)) != 0;
}

bool isIdentity(const cv::Matx33d& R) {
  constexpr double kRounding = 1e-9;
  return cv::norm(R - cv::Matx33d::eye()) < kRounding;
}

[[noreturn]] void refuseModel(const std::string& name, const std::string& model) {
  throw InputError(
      name + ": the distortion_model '" + model +
      "' is not supported; plumb_bob (5 coefficients), rational_polynomial (8) and equidistant (4) are: calibrate "
      "with one of them, or correct the name where the coefficients are those of one of them (OpenCV's fisheye "
      "model is equidistant, radtan is plumb_bob)");
}

/// Without coefficients, and without a model that says how rays run.
void normaliseWithoutModel(const std::string& name, CameraFields& camera, std::vector<std::string>& notes) {
  if (!isPinholeName(camera.distortion_model)) refuseModel(name, camera.distortion_model);
  if (cv::norm(camera.R) == 0.0) camera.R = cv::Matx33d::eye();
  if (!isRectified(camera)) {
    throw InputError(
        name + ": distortion_model is '" + camera.distortion_model +
        "' and D holds no coefficient, but R and P say that the image is not rectified; give the "
        "model (plumb_bob, with zeros where the lens has no distortion), or calibrate again");
  }
  notes.push_back(name + ": distortion_model is '" + camera.distortion_model +
                  "' and D holds no coefficient: the images are taken as rectified already");
  camera.distortion_model = kPlumbBob;
  camera.D.assign(5, 0.0);
}

}  // namespace

bool bends(const CameraFields& camera) {
  return std::any_of(camera.D.begin(), camera.D.end(), [](double value) { return value != 0.0; });
}

bool isRectified(const CameraFields& camera) {
  if (bends(camera) || camera.distortion_model == kEquidistant) return false;
  const cv::Matx33d P = camera.P.get_minor<3, 3>(0, 0);
  if (isIdentity(camera.R) && camera.K == P) return true;
  constexpr double kMoved_px = 1e-3;
  const cv::Matx33d to_raw = camera.K * camera.R.t() * P.inv();
  const double right = camera.size.width - 1, bottom = camera.size.height - 1;
  for (const cv::Vec3d& corner :
       {cv::Vec3d(0, 0, 1), cv::Vec3d(right, 0, 1), cv::Vec3d(0, bottom, 1), cv::Vec3d(right, bottom, 1)}) {
    const cv::Vec3d raw = to_raw * corner;
    const double moved_px = std::hypot(raw[0] / raw[2] - corner[0], raw[1] / raw[2] - corner[1]);
    if (!(raw[2] > 0.0 && moved_px < kMoved_px)) return false;
  }
  return true;
}

RawPixels rawPixels(const CameraFields& camera) {
  const std::size_t count = camera.D.size();
  const bool equidistant = camera.distortion_model == kEquidistant && count == 4;
  const bool polynomial = camera.distortion_model == kRationalPolynomial ||
                          camera.distortion_model == kPlumbBob || camera.distortion_model.empty();
  const bool complete = count == 0 || count == 4 || count == 5 || count == 8 || count == 12 || count == 14;
  RawPixels raw;
  if (!equidistant && (!polynomial || !complete)) return raw;
  const cv::Matx33d P = camera.P.get_minor<3, 3>(0, 0);
  if (equidistant) {
    cv::fisheye::initUndistortRectifyMap(camera.K, camera.D, camera.R, P, camera.size, CV_32FC1, raw.columns,
                                         raw.rows);
  } else {
    cv::initUndistortRectifyMap(camera.K, camera.D, camera.R, P, camera.size, CV_32FC1, raw.columns,
                                raw.rows);
  }
  return raw;
}

void normaliseLens(const std::string& name, CameraFields& camera, std::vector<std::string>& notes) {
  const auto counts = coefficientCounts().find(camera.distortion_model);
  if (counts == coefficientCounts().end()) {
    if (!bends(camera)) return normaliseWithoutModel(name, camera, notes);
    if (!plain(camera.distortion_model).empty()) refuseModel(name, camera.distortion_model);
    throw InputError(name + ": distortion_model is empty, though D holds " + std::to_string(camera.D.size()) +
                     " coefficients; name the model they belong to, such as plumb_bob, or calibrate again");
  }
  if (counts->second.count(camera.D.size()) != 0) return;
  if (!bends(camera)) {
    camera.D.assign(*counts->second.rbegin() == 4 ? 4 : camera.distortion_model == kPlumbBob ? 5 : 8, 0.0);
    return;
  }
  throw InputError(name + ": D holds " + std::to_string(camera.D.size()) + " coefficients, " +
                   camera.distortion_model + " has " +
                   (camera.distortion_model == kPlumbBob      ? "5 (k1 k2 p1 p2 k3)"
                    : camera.distortion_model == kEquidistant ? "4 (k1 k2 k3 k4)"
                                                              : "8 (k1 k2 p1 p2 k3 k4 k5 k6)") +
                   "; correct the distortion_model, or calibrate again");
}

}  // namespace stereo_nav::vision
