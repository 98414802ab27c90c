#include "fuzz/input_fuzz.h"

#include <Eigen/Geometry>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "core/rig_file.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/core/parameters.h"
#include "stereo_nav/ros/conversions.h"
#include "stereo_nav/ros/recording.h"
#include "tools/import_sequence/image_names.h"
#include "tools/import_sequence/sequence.h"

namespace stereo_nav {
namespace {

/// A folder of this process, removed at its end.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "stereo_nav_fuzz_XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) std::abort();
    path_ = pattern;
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path() const { return path_; }
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  void write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories(std::filesystem::path(*this / name).parent_path());
    std::ofstream(*this / name, std::ios::binary) << content;
  }

 private:
  std::string path_;
};

/// Two halves of an input that stands for two files.
std::pair<std::string, std::string> halves(const std::string& text) {
  const std::string separator = "\n====\n";
  const std::size_t place = text.find(separator);
  if (place == std::string::npos) return {text, text};
  return {text.substr(0, place), text.substr(place + separator.size())};
}

/// A folder whose images are written once for all inputs.
const Folder& folderOf(const std::string& left, const std::string& right) {
  static std::map<std::string, Folder> folders;
  const Folder& folder = folders[left];
  if (std::filesystem::exists(folder / left)) return folder;
  for (const std::string& camera : {left, right}) {
    for (const char* name : {"0", "1", "2"}) {
      const std::string image = camera + "/" + name + ".png";
      folder.write(image, "");
      cv::imwrite(folder / image, cv::Mat(48, 64, CV_8UC1, cv::Scalar(90)));
    }
  }
  return folder;
}

void useSequence(tools::Sequence sequence) {
  ros_io::toCalibration(sequence.left.info, sequence.right.info);
  for (std::size_t i = 0; i < sequence.left.frames->size(); ++i) sequence.left.frames->read(i);
}

/// The unit test gives one folder inputs of several kinds.
void removeCalibrations(const Folder& folder) {
  for (const char* file : {"left.yaml", "right.yaml", "intrinsics.yml", "extrinsics.yml", "camchain.yaml",
                           "calib.txt", "times.txt"}) {
    std::filesystem::remove(folder / file);
  }
}

void readImagesWith(const std::string& text, const std::string& first, const std::string& second) {
  const Folder& folder = folderOf("left", "right");
  removeCalibrations(folder);
  folder.write(first, halves(text).first);
  if (!second.empty()) folder.write(second, halves(text).second);
  useSequence(tools::readImages(folder.path()));
}

void readTimes(const std::string& text) {
  const Folder& folder = folderOf("left", "right");
  removeCalibrations(folder);
  folder.write("calib.txt", "fx 50\nfy 50\ncx 31.5\ncy 23.5\nbaseline 0.1\n");
  folder.write("times.txt", text);
  useSequence(tools::readImages(folder.path()));
}

void readKittiWith(const std::string& text) {
  const Folder& folder = folderOf("image_0", "image_1");
  folder.write("calib.txt", halves(text).first);
  folder.write("times.txt", halves(text).second);
  useSequence(tools::readKitti(folder.path()));
}

constexpr const char* kSensor =
    "T_BS:\n  data: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\nresolution: [64, 48]\n"
    "camera_model: pinhole\nintrinsics: [50, 50, 31.5, 23.5]\ndistortion_model: radial-tangential\n"
    "distortion_coefficients: [0, 0, 0, 0]\n";

void readEurocWith(const std::string& sensor, const std::string& list) {
  const Folder& folder = folderOf("cam0/data", "cam1/data");
  const std::string left = kSensor;
  std::string right = sensor;
  if (right.empty()) right = left, right.replace(right.find("0, 0, 0, 0,"), 11, "0, 0, 0.1, 0,");
  folder.write("cam0/sensor.yaml", sensor.empty() ? left : halves(sensor).first);
  folder.write("cam1/sensor.yaml", sensor.empty() ? right : halves(sensor).second);
  folder.write("cam0/data.csv", list);
  folder.write("cam1/data.csv", list);
  useSequence(tools::readEuroc(folder.path()));
}

void readRig(const std::string& text) {
  RigFile rig = RigFile::parse(text, "rig.yaml");
  rig.mounting();
  rig.setRotation("imu", rig.mounting().imu.T_base_sensor().linear());
}

/// Each line is the path of an image.
void readNames(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    names.push_back(line);
    tools::stampFromName(line, tools::Side::kLeft);
    tools::stampFromText(line);
  }
  if (!names.empty()) tools::pairByName(names, names);
}

void readBag(const std::string& bytes) {
  static const Folder folder;
  folder.write("fuzz.bag", bytes);
  const ros_io::Recording recording(folder / "fuzz.bag", {});
  ros_io::toCalibration(recording.leftInfo(), recording.rightInfo());
  recording.groundTruth("ground_truth/odom", false);
  recording.forEachPair([](const ros_io::RawPair&) {});
}

}  // namespace

void readFuzzInput(const std::string& kind, const std::uint8_t* data, std::size_t size) {
  using Reader = std::function<void(const std::string&)>;
  static const std::map<std::string, Reader> readers = {
      {"ros", [](const std::string& text) { readImagesWith(text, "left.yaml", "right.yaml"); }},
      {"opencv", [](const std::string& text) { readImagesWith(text, "intrinsics.yml", "extrinsics.yml"); }},
      {"kalibr", [](const std::string& text) { readImagesWith(text, "camchain.yaml", ""); }},
      {"kitti", readKittiWith},
      {"euroc", [](const std::string& text) { readEurocWith(text, "0,0.png\n100000000,1.png\n"); }},
      {"lists", [](const std::string& text) { readEurocWith("", text); }},
      {"rig", readRig},
      {"times", readTimes},
      {"names", readNames},
      {"bag", readBag}};
  try {
    readers.at(kind)(std::string(reinterpret_cast<const char*>(data), size));
  } catch (const InputError&) {
    // refused, as it should be
  } catch (const ParameterError&) {
    // likewise
  }
}

}  // namespace stereo_nav
