#include "tools/check_calibration/image_pairs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/recording.h"

namespace stereo_nav::tools {
namespace {

namespace fs = std::filesystem;

bool isImage(const fs::path& path) {
  static const std::set<std::string> endings = {".png", ".jpg", ".jpeg", ".pgm",
                                                ".ppm", ".bmp", ".tif",  ".tiff"};
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return fs::is_regular_file(path) && endings.count(ending) != 0;
}

/// Images of a folder whose names begin with `prefix`, by the rest of the name.
std::map<std::string, fs::path> imagesOf(const fs::path& folder, const std::string& prefix) {
  std::map<std::string, fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(prefix, 0) == 0 && isImage(entry.path()))
      images[name.substr(prefix.size())] = entry.path();
  }
  return images;
}

cv::Mat readGrey(const fs::path& path) {
  cv::Mat image = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw InputError(path.string() + ": cannot be read as an image");
  return image;
}

}  // namespace

void readFolder(const std::string& folder, const PairSink& sink) {
  const fs::path root(folder);
  const bool two_folders = fs::is_directory(root / "left") && fs::is_directory(root / "right");
  const auto left = two_folders ? imagesOf(root / "left", "") : imagesOf(root, "left");
  const auto right = two_folders ? imagesOf(root / "right", "") : imagesOf(root, "right");
  bool any = false;
  for (const auto& [name, path] : left) {
    const auto partner = right.find(name);
    if (partner == right.end()) continue;
    any = true;
    if (!sink({path.stem().string(), readGrey(path), readGrey(partner->second), 0.0})) return;
  }
  if (!any) {
    throw InputError(folder + ": no pair of images: " + std::to_string(left.size()) + " left and " +
                     std::to_string(right.size()) +
                     " right ones; pairs are left01.png and right01.png, or equal names in left/ and right/");
  }
}

void readBag(const std::string& path, double interval_s, const InfoSink& infos, const PairSink& sink) {
  const ros_io::Recording recording(path, {});
  infos({recording.leftInfo(), recording.rightInfo()});
  double last_s = -std::numeric_limits<double>::infinity();
  bool wanted = true;
  recording.forEachPair([&](const ros_io::RawPair& pair) {
    if (!wanted || pair.left_time_s - last_s < interval_s) return;
    last_s = pair.left_time_s;
    wanted = sink({fmt::format("{:.3f}", pair.left_time_s), pair.left, pair.right,
                   pair.right_time_s - pair.left_time_s});
  });
}

}  // namespace stereo_nav::tools
