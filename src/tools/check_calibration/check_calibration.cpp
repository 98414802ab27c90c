// Measures how good a stereo calibration is, and where the checkerboard stands: from images, a recording or
// live topics.
#include <ros/ros.h>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>

#include "core/atomic_file.h"
#include "core/rig_file.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"
#include "tools/check_calibration/check_report.h"
#include "tools/check_calibration/image_pairs.h"
#include "tools/common/command_line.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

namespace fs = std::filesystem;
namespace po = boost::program_options;

struct Options {
  std::string input;  ///< empty: live
  std::string calibration;
  calibration::Checkerboard board;
  std::size_t views = std::numeric_limits<std::size_t>::max();
  double interval_s = 0.5;
  double duration_s = 120.0;
  std::string json;
  std::string rig;
};

void parseSize(const std::string& size, calibration::Checkerboard& board) {
  int used = 0;
  if (std::sscanf(size.c_str(), "%dx%d%n", &board.columns, &board.rows, &used) != 2 ||
      used != static_cast<int>(size.size()) || board.columns < 3 || board.rows < 3) {
    throw InputError("--size is '" + size + "'; it counts inner corners as 8x6, at least 3x3");
  }
}

std::optional<Options> parse(int argc, char** argv) {
  Options options;
  std::string size = "8x6";
  po::options_description visible(helpHeading(
      "usage: check_calibration [INPUT] [options]",
      "Measures on views of a checkerboard how good a stereo calibration is, and where the board stands. "
      "INPUT is a folder with left01.png, right01.png, ... (or left/01.png, right/01.png), or a bag with "
      "raw images. Without INPUT it listens to camera/{left,right}/{image_raw,camera_info}. Exit status: 0 "
      "good, 1 poor, 2 input that cannot be used."));
  visible.add_options()        //
      ("help,h", "this text")  //
      ("calibration", po::value(&options.calibration),
       "folder with left.yaml and right.yaml; default: INPUT, or the recorded or live camera_info")  //
      ("size", po::value(&size)->default_value(size), "inner corners of the board, columns x rows")  //
      ("square", numberOption(options.board.square_m),
       "side of a square, m")                                                       //
      ("views", po::value(&options.views), "views to take; default: all, live 20")  //
      ("interval", po::value(&options.interval_s)->default_value(options.interval_s),
       "seconds between two views, bag and live")  //
      ("duration", po::value(&options.duration_s)->default_value(options.duration_s),
       "seconds to listen, live")                                                          //
      ("json", po::value(&options.json), "write the report into this file, too, as JSON")  //
      ("rig", po::value(&options.rig),
       "rig file whose section uncertainty is set to the standard deviations found, from which the odometry computes "
       "its covariances");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "input", values)) return std::nullopt;
  if (values.count("input") != 0) options.input = values["input"].as<std::string>();
  if (options.input.empty() && values.count("views") == 0) options.views = 20;
  parseSize(size, options.board);
  if (!(options.board.square_m > 0.001 && options.board.square_m < 1.0)) {
    throw InputError("--square is in metres, 0.001 to 1; a square of 51 mm is 0.051");
  }
  if (options.views < 1 || !(options.interval_s >= 0.0) || !(options.duration_s > 0.0)) {
    throw InputError("--views and --duration must be above 0, --interval not below");
  }
  return options;
}

/// Finds the board in each pair and measures it.
class Checker {
 public:
  explicit Checker(const Options& options) : options_(options) {
    checked_.board = options.board;
    checked_.input = options.input.empty() ? "live" : options.input;
  }

  void useCalibration(const CameraInfos& infos, const std::string& source) {
    checked_.rig = toStereoRig(infos);
    checked_.calibration = source;
    std::cout << viewHeading() << std::flush;
  }

  /// False: enough.
  bool take(const ImagePair& pair) {
    ++checked_.pairs;
    for (const auto& [image, side] : {std::pair(&pair.left, "left"), std::pair(&pair.right, "right")}) {
      const cv::Size size = checked_.rig.left.size;
      if (image->size() == size) continue;
      throw InputError(pair.name + ": the " + side + " image is " + std::to_string(image->cols) + "x" +
                       std::to_string(image->rows) + ", the calibration for " + std::to_string(size.width) +
                       "x" + std::to_string(size.height) + "; calibrate at the size that is used");
    }
    const auto corners = calibration::findCorners(pair.left, pair.right, options_.board);
    if (!corners) return true;
    views_.push_back(calibration::measureView(checked_.rig, options_.board, pair.name, *corners));
    corners_.push_back(*corners);
    checked_.largest_time_offset_s = std::max(checked_.largest_time_offset_s, std::abs(pair.time_offset_s));
    std::cout << viewLine(views_.back()) << std::flush;
    return views_.size() < options_.views;
  }

  /// Exit status.
  int report() const {
    if (views_.empty()) {
      throw InputError(
          "the board of " + std::to_string(options_.board.columns) + "x" +
          std::to_string(options_.board.rows) + " inner corners is in none of " +
          std::to_string(checked_.pairs) +
          " pairs: check --size, show the whole board to both cameras, sharp and with a white margin");
    }
    const auto check = calibration::checkCalibration(checked_.rig, views_, corners_);
    const auto uncertainty = calibration::calibrationUncertainty(checked_.rig, checked_.board, views_);
    std::cout << reportText(checked_, check, uncertainty);
    if (!options_.json.empty()) writeFileAtomically(options_.json, reportJson(checked_, check, uncertainty));
    if (!options_.rig.empty()) {
      RigFile rig = RigFile::load(options_.rig);
      setUncertainty(uncertainty, rig);
      writeFileAtomically(options_.rig, rig.text());
    }
    return check.good() ? 0 : 1;
  }

 private:
  Options options_;
  CheckedInput checked_;
  std::vector<calibration::ViewFigures> views_;
  std::vector<calibration::BoardCorners> corners_;
};

int run(int argc, char** argv) {
  ros::init(argc, argv, "check_calibration", ros::init_options::AnonymousName);
  const auto options = parse(argc, argv);
  if (!options) return 0;
  Checker checker(*options);
  const auto take = [&](const ImagePair& pair) { return checker.take(pair); };
  const bool folder = fs::is_directory(options->input);
  const std::string calibration =
      options->calibration.empty() && folder ? options->input : options->calibration;
  if (!calibration.empty()) checker.useCalibration(readCalibrationFolder(calibration), calibration);
  const auto use_recorded = [&](const CameraInfos& infos) {
    if (calibration.empty()) checker.useCalibration(infos, "camera_info");
  };
  if (folder) {
    readFolder(options->input, take);
  } else if (!options->input.empty()) {
    readBag(options->input, options->interval_s, use_recorded, take);
  } else if (!ros::master::check()) {
    throw InputError(
        "no INPUT given, and no ROS master to listen to the cameras; see check_calibration --help");
  } else {
    readTopics(options->interval_s, options->duration_s,
               calibration.empty() ? InfoSink(use_recorded) : InfoSink(), take);
  }
  return checker.report();
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("check_calibration", stereo_nav::tools::run, argc, argv);
}
