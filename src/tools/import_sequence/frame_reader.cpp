#include "tools/import_sequence/frame_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <set>
#include <utility>

#include "stereo_nav/core/input_error.h"
#include "tools/import_sequence/image_names.h"

namespace stereo_nav::tools {
namespace {

class ImageFiles : public FrameReader {
 public:
  explicit ImageFiles(std::vector<std::string> paths) : paths_(std::move(paths)) {}

  std::size_t size() const override { return paths_.size(); }

  cv::Mat read(std::size_t index) override {
    const std::string& path = paths_.at(index);
    if (!std::filesystem::exists(path)) throw InputError(path + ": does not exist; is the folder complete?");
    cv::Mat image = cv::imread(path, cv::IMREAD_UNCHANGED);
    if (image.empty()) throw InputError(path + ": is no image or is damaged; copy it again");
    const int type = image.type();
    if (type == CV_8UC1 || type == CV_8UC3 || type == CV_16UC1) return image;
    throw InputError(path + ": images of OpenCV type " + cv::typeToString(type) +
                     " are not supported; convert them to 8-bit grey, 8-bit colour or 16-bit grey");
  }

 private:
  std::vector<std::string> paths_;
};

cv::VideoCapture openVideo(const std::string& path) {
  cv::VideoCapture video;
  if (!std::filesystem::exists(path)) throw InputError(path + ": does not exist");
  if (!video.open(path)) throw InputError(path + ": cannot be opened as a video; is its codec installed?");
  return video;
}

class Video : public FrameReader {
 public:
  explicit Video(const std::string& path) : path_(path), video_(openVideo(path)) {
    while (video_.grab()) ++size_;
    if (size_ == 0) throw InputError(path + ": holds no frame that can be decoded");
    rewind();
  }

  std::size_t size() const override { return size_; }

  cv::Mat read(std::size_t index) override {
    if (index < next_) rewind();
    while (next_ < index && video_.grab()) ++next_;
    cv::Mat image;
    if (next_ != index || !video_.read(image)) {
      throw InputError(path_ + ": frame " + std::to_string(index) + " cannot be decoded");
    }
    ++next_;
    return image;
  }

 private:
  void rewind() {
    video_ = openVideo(path_);
    next_ = 0;
  }

  std::string path_;
  cv::VideoCapture video_;
  std::size_t size_ = 0;
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<FrameReader> readImageFiles(std::vector<std::string> paths) {
  return std::make_unique<ImageFiles>(std::move(paths));
}

std::unique_ptr<FrameReader> readVideo(const std::string& path) {
  return std::make_unique<Video>(path);
}

double videoRate(const std::string& path) {
  const double rate_hz = openVideo(path).get(cv::CAP_PROP_FPS);
  if (std::isfinite(rate_hz) && rate_hz > 0.0) return rate_hz;
  throw InputError(path + ": states no frame rate; give it in calib.txt, e.g. 'fps 15'");
}

std::vector<std::string> listImages(const std::string& folder) {
  const std::set<std::string> extensions = {".png", ".jpg", ".jpeg", ".pgm", ".ppm", ".bmp", ".tif", ".tiff"};
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    std::string extension = entry.path().extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extensions.count(extension) != 0) paths.push_back(entry.path().string());
  }
  if (error) throw InputError(folder + ": cannot be read: " + error.message());
  if (paths.empty()) throw InputError(folder + ": holds no image");
  std::sort(paths.begin(), paths.end(), naturalLess);
  return paths;
}

}  // namespace stereo_nav::tools
