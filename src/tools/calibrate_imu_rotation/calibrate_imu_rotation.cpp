// Finds the rotation of the IMU on the robot from a recording in which the rig was turned about all axes.
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>

#include "calibration/imu_camera_rotation.h"
#include "core/angles.h"
#include "core/atomic_file.h"
#include "core/rig_file.h"
#include "ros/package_files.h"
#include "ros/stereo_processing.h"
#include "stereo_nav/core/input_error.h"
#include "stereo_nav/odometry/method/odometry_config.h"
#include "stereo_nav/ros/recording.h"
#include "tools/common/command_line.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

struct Options {
  std::string bag, rig, config = "vo.yaml";
  ros_io::RecordingOptions part;
  calibration::ImuCameraRotationParams params;
  bool dry_run = false;
};

std::optional<Options> parse(int argc, char** argv) {
  Options options;
  po::options_description visible(helpHeading(
      "usage: calibrate_imu_rotation BAG --rig FILE [options]",
      "Finds the rotation of the IMU against the cameras and writes it as roll_deg, pitch_deg and yaw_deg "
      "of mounting/imu into the rig file; nothing else in it changes. BAG holds raw stereo images, "
      "camera_info and imu/data (or imu_quat) of half a minute in which the rig is turned by some 30 deg "
      "to and fro about all three axes, in front of texture. Exit status: 0 written, 1 the recording does "
      "not determine the rotation (nothing is written), 2 input that cannot be used."));
  visible.add_options()                                                                     //
      ("help,h", "this text")                                                               //
      ("rig", po::value(&options.rig), "rig file, with the mounting of camera and IMU")     //
      ("dry-run", po::bool_switch(&options.dry_run), "only say what would be written")      //
      ("start", po::value(&options.part.start_s), "seconds of the recording to skip")       //
      ("duration", po::value(&options.part.duration_s), "seconds of the recording to use")  //
      ("max-offset", numberOption(options.params.max_offset_s),
       "largest error of the IMU's stamps that is searched for, s")  //
      ("config", po::value(&options.config)->default_value(options.config), "parameters of the odometry");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "bag", values)) return std::nullopt;
  if (values.count("bag") == 0 || options.rig.empty()) {
    throw InputError("BAG and --rig FILE are needed; see calibrate_imu_rotation --help");
  }
  options.bag = values["bag"].as<std::string>();
  validateParameters(options.params, "options");
  return options;
}

/// Orientations of the left camera by vision alone: the odometry gets no IMU.
std::vector<calibration::CameraOrientation> followCamera(const Options& options,
                                                         const ros_io::Recording& recording) {
  const ros_io::StereoProcessing processing(recording.leftInfo(), recording.rightInfo(), {});
  const odometry::OdometryConfig config = odometry::loadOdometryConfig(ros_io::configFile(options.config));
  if (config.method() == odometry::Method::kThesis) {
    throw InputError(
        options.config +
        ": this method takes the rotation from the IMU; use vo.yaml, which measures it in the images");
  }
  const auto odometry = odometry::makeOdometry(config, processing.calibration(), Eigen::Matrix3d::Identity());
  std::vector<calibration::CameraOrientation> orientations;
  int run = 0;
  std::size_t frames = 0;
  recording.forEachPair([&](const ros_io::RawPair& pair) {
    odometry::StereoFrame frame;
    frame.left_time_s = pair.left_time_s;
    frame.right_time_s = pair.right_time_s;
    frame.readout_s = pair.rolling_shutter_s;
    frame.left = processing.rectifyLeft(pair.left);
    frame.right = processing.rectifyRight(pair.right);
    const odometry::FrameResult result = odometry->process(frame);
    if (result.state == odometry::State::kTracking) {
      orientations.push_back({pair.left_time_s, result.T_start_camera.linear(), run});
    } else {
      ++run;
    }
    if (++frames % 50 == 0)
      std::cerr << "\r" << frames << " of " << recording.pairs() << " frames" << std::flush;
  });
  std::cerr << "\r" << orientations.size() << " of " << recording.pairs() << " frames followed\n";
  return orientations;
}

void print(const calibration::ImuCameraRotation& found) {
  const Eigen::Vector3d rate = found.rate_rms_rad_s / kRadPerDeg, sigma = found.sigma_rad / kRadPerDeg;
  std::printf("motion: %zu turns, RMS rates %.1f, %.1f and %.1f deg/s about its own three axes\n",
              found.turns, rate(0), rate(1), rate(2));
  std::printf("agreement of cameras and IMU: %.3f deg in turns of %.1f deg\n",
              found.residual_rms_rad / kRadPerDeg, found.turn_rms_rad / kRadPerDeg);
  std::printf("IMU stamps against the images': %+.1f ms (deviation %.1f ms)%s\n", 1e3 * found.imu_offset_s,
              1e3 * found.imu_offset_sigma_s,
              std::abs(found.imu_offset_s) > 0.02 ? "; worth correcting" : "");
  std::printf("bias of its rates: %.4f, %.4f, %.4f rad/s\n", found.bias_rad_s.x(), found.bias_rad_s.y(),
              found.bias_rad_s.z());
  std::printf("deviation about the camera's x, y, z axis: %.3f, %.3f, %.3f deg (of chance alone)\n",
              sigma.x(), sigma.y(), sigma.z());
}

int run(int argc, char** argv) {
  const auto options = parse(argc, argv);
  if (!options) return 0;
  RigFile rig = RigFile::load(options->rig);
  rig.requireRotation("camera");
  const Eigen::Matrix3d R_base_camera = rig.mounting().camera.T_base_optical().linear();
  // A file that cannot be written is refused before the long part begins.
  RigFile(rig).setRotation("imu", Eigen::Matrix3d::Identity());

  const ros_io::Recording recording(options->bag, options->part);
  const auto camera = followCamera(*options, recording);
  const auto found = calibration::calibrateImuCameraRotation(camera, recording.imu(), options->params);
  if (found.turn_rms_rad > 0.0) print(found);
  if (!found.usable()) {
    std::fprintf(stderr, "calibrate_imu_rotation: %s: %s\n", options->bag.c_str(), found.refusal.c_str());
    return 1;
  }
  const Eigen::Matrix3d R_base_imu = R_base_camera * found.R_camera_imu;
  SensorMounting angles;
  angles.setRotation(R_base_imu);
  std::printf("mounting/imu: roll_deg %.2f, pitch_deg %.2f, yaw_deg %.2f\n", angles.roll_deg,
              angles.pitch_deg, angles.yaw_deg);
  if (!options->dry_run) {
    rig.setRotation("imu", R_base_imu);
    writeFileAtomically(options->rig, rig.text());
    std::printf("written into %s\n", options->rig.c_str());
  }
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("calibrate_imu_rotation", stereo_nav::tools::run, argc, argv);
}
