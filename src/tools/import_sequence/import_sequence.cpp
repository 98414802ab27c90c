// Turns public stereo recordings into bags with the topics of a stereo rig.
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <set>

#include "core/atomic_file.h"
#include "kinematics/drive_file.h"
#include "ros/judged_infos.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/ros/conversions.h"
#include "tools/common/command_line.h"
#include "tools/common/program.h"
#include "tools/import_sequence/derived_sequence.h"
#include "tools/import_sequence/laser_sequence.h"
#include "tools/import_sequence/monoslam_sequence.h"
#include "tools/import_sequence/sequence_bag.h"
#include "tools/import_sequence/sixteen_bits.h"
#include "tools/import_sequence/wheel_sequence.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

constexpr const char* kUsage =
    "usage: import_sequence --format euroc|kitti|kitti_raw|images|optiodom|carmen|monoslam DIR --output BAG [options]\n"
    "Turns a public recording into a bag with the topics of a stereo rig, of wheels, of a laser, or of one camera.\n\n"
    "  euroc   DIR/cam0, cam1 (data.csv, data/, sensor.yaml), imu0, state_groundtruth_estimate0;\n"
    "          raw images, rectified downstream by the camera_infos written\n"
    "  kitti   DIR/image_0, image_1, calib.txt, times.txt, poses.txt (KITTI odometry); time 0 becomes\n"
    "          1000 s\n"
    "  kitti_raw  DIR = a drive, YYYY_MM_DD/YYYY_MM_DD_drive_NNNN_sync (rectified) or _extract (raw), with\n"
    "          image_00, image_01 (else image_02, image_03) and oxts; calib_*.txt beside the drive\n"
    "  images  DIR/left, right with images, or two videos *L.mp4, *R.mp4 (*left, *right), rectified;\n"
    "          calib.txt with the lines fx, fy, cx, cy (px), baseline (m) and, if need be, fps;\n"
    "          pairs have equal names; stamps come from times.txt, from names that are dates, or from fps;\n"
    "          not rectified with left.yaml and right.yaml (ROS), camchain.yaml (Kalibr), or "
    "intrinsics.yml and\n"
    "          extrinsics.yml (OpenCV)\n"
    "  optiodom  DIR = a run, SET_run-NN.csv, with SET_metadata.csv beside it: pulses of three omni wheels (omni3)\n"
    "          or of two on one axle (diff), and motion capture; time 0 becomes 1000 s; of the options --rig alone applies\n"
    "  carmen  DIR = a log (may be gzipped) with FLASER and ODOM lines, whose FLASER poses a SLAM system corrected:\n"
    "          scan, wheel/odom and, as ground truth, the corrected poses; none of the options applies\n"
    "  monoslam  DIR/frames = the public MonoSLAM sequence, 320x240, with its wide-angle lens: camera/left alone, at 30 Hz;\n"
    "          none of the options applies\n\n"
    "base_link is the IMU (the default for euroc and kitti_raw) or the left camera with x forward, y left, z up (REP-103;\n"
    "the default for the others). The ground truth gives poses of base_link.\n\nOptions";

constexpr const char* kOptiodom = "optiodom";
constexpr const char* kCarmen = "carmen";
constexpr const char* kMonoslam = "monoslam";

std::atomic<bool> interrupted{false};

struct Arguments {
  std::string format;
  std::string folder;
  std::string output;
  std::string rig;
  bool reverse = false;
  bool mirror = false;
  BagOptions bag;
};

po::options_description describeOptions(Arguments& arguments, double& right_stamp_offset_ms) {
  po::options_description options(kUsage);
  options.add_options()("help,h", "this text");
  options.add_options()("format", po::value(&arguments.format), "layout of the recording");
  options.add_options()("output", po::value(&arguments.output), "bag to write; replaced if it exists");
  options.add_options()("every", po::value(&arguments.bag.every), "keep only every N-th pair");
  options.add_options()("right-lag-frames", po::value(&arguments.bag.right_lag_frames),
                        "take the right image K original frames later than the left, with its true stamp");
  options.add_options()("right-stamp-offset-ms", po::value(&right_stamp_offset_ms),
                        "add a constant error to the right stamps");
  options.add_options()("no-imu", "leave the IMU out");
  options.add_options()("reverse", po::bool_switch(&arguments.reverse), "let time run backwards");
  options.add_options()("mirror", po::bool_switch(&arguments.mirror),
                        "flip the images left to right and swap the cameras");
  options.add_options()("rig", po::value(&arguments.rig),
                        "optiodom: rig file to write, with the nominal geometry of the wheels");
  options.add_options()("base-frame", po::value<std::string>(), "imu or camera: where base_link is");
  return options;
}

/// Whether DIR is a file, not a folder.
bool isOneFile(const std::string& format) {
  return format == kOptiodom || format == kCarmen;
}

void checkArguments(const Arguments& arguments) {
  const std::set<std::string> formats = {"euroc",   "kitti", "kitti_raw", "images",
                                         kOptiodom, kCarmen, kMonoslam};
  if (formats.count(arguments.format) == 0) {
    throw InputError("--format must be euroc, kitti, kitti_raw, images, optiodom, carmen or monoslam" +
                     (arguments.format.empty() ? std::string() : ", not '" + arguments.format + "'"));
  }
  if (arguments.folder.empty()) throw InputError("no DIR given");
  if (arguments.output.empty()) throw InputError("no --output BAG given");
  if (arguments.bag.every < 1) throw InputError("--every must be 1 or more");
  if (arguments.bag.right_lag_frames < 0) throw InputError("--right-lag-frames must be 0 or more");
  // Far more than any camera is off; the stamps must stay after time zero.
  if (!(std::abs(arguments.bag.right_stamp_offset_s) <= 100.0)) {
    throw InputError("--right-stamp-offset-ms must lie between -100000 and 100000");
  }
  if (!arguments.rig.empty() && arguments.format != kOptiodom)
    throw InputError("--rig is for --format optiodom: the other layouts know no wheels");
  if (!isOneFile(arguments.format) && !std::filesystem::is_directory(arguments.folder)) {
    throw InputError(arguments.folder + ": is no folder; give the one that holds the recording");
  }
}

/// Whether the layout has a body that carries the IMU.
bool knowsImu(const std::string& format) {
  return format == "euroc" || format == "kitti_raw";
}

BaseFrame baseFrame(const std::string& name, const std::string& format) {
  if (name == "camera") return BaseFrame::kCamera;
  if (name != "imu") throw InputError("--base-frame must be imu or camera, not '" + name + "'");
  if (knowsImu(format)) return BaseFrame::kImu;
  throw InputError("--base-frame imu: the " + format + " layout knows no IMU; use --base-frame camera");
}

/// False when help was asked for and printed.
bool parse(int argc, char** argv, Arguments& arguments) {
  double right_stamp_offset_ms = 0.0;
  const po::options_description visible = describeOptions(arguments, right_stamp_offset_ms);
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "dir", values)) return false;
  if (values.count("dir") != 0) arguments.folder = values["dir"].as<std::string>();
  arguments.bag.imu = values.count("no-imu") == 0;
  arguments.bag.right_stamp_offset_s = 1e-3 * right_stamp_offset_ms;
  checkArguments(arguments);
  const char* default_base = knowsImu(arguments.format) ? "imu" : "camera";
  arguments.bag.base_frame =
      baseFrame(values.count("base-frame") != 0 ? values["base-frame"].as<std::string>() : default_base,
                arguments.format);
  return true;
}

Sequence readSequence(const Arguments& arguments) {
  if (arguments.format == "euroc") return readEuroc(arguments.folder, arguments.bag.imu);
  if (arguments.format == "kitti_raw") return readKittiRaw(arguments.folder, arguments.bag.imu);
  return arguments.format == "kitti" ? readKitti(arguments.folder) : readImages(arguments.folder);
}

/// Before images are read: a calibration that no odometry can use is no recording.
void checkCalibration(const Arguments& arguments, const Sequence& sequence) {
  try {
    ros_io::judgeInfos(sequence.left.info, sequence.right.info);
  } catch (const std::exception& error) {
    throw InputError(arguments.folder + ": " + error.what());
  }
}

void showProgress(std::size_t done, std::size_t all) {
  if (interrupted) throw InputError("interrupted; no bag was written");
  if (isatty(STDERR_FILENO) == 0 && done != all) return;
  std::fprintf(stderr, "\r%zu of %zu pairs%s", done, all, done == all ? "\n" : "");
}

int importWheels(const Arguments& arguments) {
  const WheelSequence sequence = readOptiodom(arguments.folder);
  writeWheelBag(sequence, arguments.output);
  if (!arguments.rig.empty())
    writeFileAtomically(arguments.rig,
                        "# Nominal geometry of the wheels; calibrate_wheels finds the true one.\n" +
                            kinematics::driveSection(sequence.drive));
  std::printf("%s: %zu readings of %zu wheels\n", arguments.output.c_str(), sequence.readings.size(),
              sequence.drive.wheels.size());
  return 0;
}

int importLaser(const Arguments& arguments) {
  const LaserSequence sequence = readCarmen(arguments.folder);
  if (sequence.repeated > 0) {
    std::fprintf(
        stderr,
        "import_sequence: note: %zu scans whose stamp is not later than the one before are left out\n",
        sequence.repeated);
  }
  writeLaserBag(sequence, arguments.output);
  std::printf("%s: %zu scans, %zu wheel poses, %.1f m by the wheels\n", arguments.output.c_str(),
              sequence.scans.size(), sequence.wheels.size(), pathLength(sequence.wheels));
  return 0;
}

int run(int argc, char** argv) {
  Arguments arguments;
  if (!parse(argc, argv, arguments)) return 0;
  { const AtomicFile writable(arguments.output); }  // before the work, not after it
  if (arguments.format == kOptiodom) return importWheels(arguments);
  if (arguments.format == kCarmen) return importLaser(arguments);
  if (arguments.format == kMonoslam) {
    std::printf("%s: %zu images\n", arguments.output.c_str(),
                importMonoslam(arguments.folder, arguments.output));
    return 0;
  }
  Sequence sequence = readSequence(arguments);
  checkCalibration(arguments, sequence);
  useFullRange(sequence);
  if (arguments.reverse) reverse(sequence);
  if (arguments.mirror) mirror(sequence);
  for (const auto& note : sequence.notes) std::fprintf(stderr, "import_sequence: note: %s\n", note.c_str());
  const BagSummary summary = writeBag(sequence, arguments.bag, arguments.output, showProgress);
  if (summary.left_without_partner > 0) {
    std::fprintf(stderr, "import_sequence: note: %zu left images without a right one are left out\n",
                 summary.left_without_partner);
  }
  std::printf("%s: %zu pairs\n", arguments.output.c_str(), summary.pairs);
  return 0;
}

void interrupt(int /*signal*/) {
  interrupted = true;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  signal(SIGINT, stereo_nav::tools::interrupt);
  signal(SIGTERM, stereo_nav::tools::interrupt);
  return stereo_nav::tools::runProgram("import_sequence", stereo_nav::tools::run, argc, argv);
}
