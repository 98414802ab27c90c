#include <filesystem>
#include <map>
#include <optional>

#include "core/text_table.h"
#include "stereo_nav/core/input_error.h"
#include "tools/import_sequence/image_stamps.h"
#include "tools/import_sequence/raw_pair.h"
#include "tools/import_sequence/rectified_camera.h"
#include "tools/import_sequence/sequence.h"

namespace stereo_nav::tools {
namespace {

namespace fs = std::filesystem;

/// calib.txt: `key value` lines.
class CalibrationFile {
 public:
  explicit CalibrationFile(const std::string& path) : path_(path) {
    exists_ = fs::exists(path);
    if (!exists_) return;
    for (const auto& row : readTextTable(path)) values_[row.fields[0]] = row.number(1);
  }

  bool has(const std::string& key) const { return values_.count(key) != 0; }

  double positive(const std::string& key) const {
    if (!exists_) throw InputError(path_ + ": does not exist; " + expected());
    if (!has(key)) throw InputError(path_ + ": has no line '" + key + "'; " + expected());
    const double value = values_.at(key);
    if (value > 0.0) return value;
    throw InputError(path_ + ": " + key + " is " + std::to_string(value) + ", must be above 0");
  }

 private:
  static std::string expected() {
    return "expected are the lines 'fx', 'fy', 'cx', 'cy' in px and 'baseline' in m, such as 'fx 567.2', of "
           "the rectified pair; for images that are not rectified left.yaml and right.yaml (ROS), "
           "camchain.yaml "
           "(Kalibr), or intrinsics.yml and extrinsics.yml (OpenCV) in its place";
  }

  std::string path_;
  bool exists_ = false;
  std::map<std::string, double> values_;
};

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// The one video of the folder whose name ends in `letter` or `word`, e.g. robotL.mp4 or left.avi.
std::string findVideo(const std::string& folder, const std::string& letter, const std::string& word) {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    const std::string stem = entry.path().stem().string();
    const bool is_video =
        extension == ".mp4" || extension == ".avi" || extension == ".mkv" || extension == ".mov";
    if (is_video && (endsWith(stem, letter) || endsWith(stem, word))) found.push_back(entry.path().string());
  }
  if (found.size() == 1) return found.front();
  throw InputError(folder + ": holds " + (found.empty() ? "no" : "more than one") + " video *" + letter +
                   ".mp4 or *" + word + ".mp4 (or .avi, .mkv, .mov), and not both folders left/ and right/");
}

CameraTrack readTrack(std::unique_ptr<FrameReader> frames, double rate_hz) {
  CameraTrack track;
  for (std::size_t i = 0; i < frames->size(); ++i) track.stamps.push_back(stampOfIndex(i, rate_hz));
  track.frames = std::move(frames);
  return track;
}

void readVideos(const std::string& folder, const CalibrationFile& calibration, Sequence& sequence) {
  const std::string left = findVideo(folder, "L", "left");
  const std::string right = findVideo(folder, "R", "right");
  const double rate_hz = calibration.has("fps") ? calibration.positive("fps") : videoRate(left);
  sequence.left = readTrack(readVideo(left), rate_hz);
  sequence.right = readTrack(readVideo(right), rate_hz);
}

void readFrames(const std::string& folder, const CalibrationFile& calibration, Sequence& sequence) {
  if (fs::is_directory(folder + "/left") && fs::is_directory(folder + "/right")) {
    std::optional<double> rate_hz;
    if (calibration.has("fps")) rate_hz = calibration.positive("fps");
    readImageFolders(folder, rate_hz, sequence);
    return;
  }
  readVideos(folder, calibration, sequence);
  const std::size_t frames = sequence.left.frames->size();
  if (frames == sequence.right.frames->size()) return;
  sequence.notes.push_back("left has " + std::to_string(frames) + " frames, right " +
                           std::to_string(sequence.right.frames->size()) + ": the surplus is left out");
}

/// The left camera's numbers with the right one's baseline; the size is that of the images.
RectifiedCamera readRectified(const CalibrationFile& calibration) {
  return {0,
          0,
          calibration.positive("fx"),
          calibration.positive("fy"),
          calibration.positive("cx"),
          calibration.positive("cy"),
          calibration.positive("baseline")};
}

void useRectified(RectifiedCamera camera, Sequence& sequence) {
  const cv::Mat image = sequence.left.frames->read(0);
  camera.width = image.cols;
  camera.height = image.rows;
  sequence.right.info = toCameraInfo(camera);
  camera.baseline_m = 0.0;
  sequence.left.info = toCameraInfo(camera);
}

}  // namespace

Sequence readImages(const std::string& folder) {
  const CalibrationFile calibration(folder + "/calib.txt");
  const auto raw = readRawPair(folder);
  const auto ros = readRosPair(folder);
  if ((raw && ros) || (calibration.has("fx") && (raw || ros))) {
    throw InputError(folder + ": holds more than one calibration (" +
                     (calibration.has("fx") ? folder + "/calib.txt" : ros->source) + " and " +
                     (raw ? raw->source : ros->source) + "); leave the one that is right");
  }
  RectifiedCamera camera{};
  if (!raw && !ros) camera = readRectified(calibration);
  Sequence sequence;
  readFrames(folder, calibration, sequence);
  if (raw) {
    useRawPair(*raw, sequence);
  } else if (ros) {
    useRectification(*ros, sequence);
  } else {
    useRectified(camera, sequence);
  }
  return sequence;
}

}  // namespace stereo_nav::tools
