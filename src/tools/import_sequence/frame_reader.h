#pragma once

#include <cstddef>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace stereo_nav::tools {

/// The images of one camera, read when asked for.
class FrameReader {
 public:
  virtual ~FrameReader() = default;

  virtual std::size_t size() const = 0;

  /// Frame `index` < size(), CV_8UC1, CV_8UC3 (blue, green, red) or CV_16UC1. A step back in a video starts
  /// it anew. Throws InputError that names the file.
  virtual cv::Mat read(std::size_t index) = 0;
};

/// Images in the order given.
std::unique_ptr<FrameReader> readImageFiles(std::vector<std::string> paths);

/// Frames of a video file. Counts them by running through it once, since the counts that containers state are
/// often wrong. Throws InputError when it cannot be opened or holds no frame.
std::unique_ptr<FrameReader> readVideo(const std::string& path);

/// Frames per second that a video states. Throws InputError when it states none.
double videoRate(const std::string& path);

/// Image files of a folder in the natural order of their names. Throws InputError when there is none.
std::vector<std::string> listImages(const std::string& folder);

}  // namespace stereo_nav::tools
