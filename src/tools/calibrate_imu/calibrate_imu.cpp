// Calibrates a raw IMU module: gyroscope at rest, then accelerometer (and magnetometer) by slow turns.
#include <filesystem>
#include <iostream>

#include "sensors/serial/steady_clock.h"
#include "stereo_nav/sensors/imu/calibration.h"
#include "tools/common/command_line.h"
#include "tools/common/imu_source.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

struct Options {
  ImuSource source;
  double turns_s = 60.0;
  double field_uT = 50.0;
  std::string output = "imu_calibration.yaml";
  imu::GyroCalibrationParams gyro;
};

/// Accelerations taken while the module turns faster than this do not show gravity alone.
constexpr double kSlow_rad_s = 1.5;
constexpr double kPatience_s = 10.0;

bool parse(int argc, char** argv, Options& options) {
  po::options_description visible(helpHeading(
      "usage: calibrate_imu --port PORT [options]",
      "Lay the module still for the first part, then turn it slowly once about each of its three axes."));
  visible.add_options()("help,h", "this text");
  options.source.protocol = "raw";
  options.source.device.baud_rate = 1000000;
  options.source.addOptions(visible);
  visible.add_options()  //
      ("rest", po::value(&options.gyro.duration_s)->default_value(options.gyro.duration_s),
       "seconds at rest")                                                                           //
      ("turns", po::value(&options.turns_s)->default_value(options.turns_s), "seconds of turning")  //
      ("field", po::value(&options.field_uT)->default_value(options.field_uT),
       "strength of the earth's magnetic field here, uT")  //
      ("output", po::value(&options.output)->default_value(options.output), "calibration file");
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "", values)) return false;
  if (options.source.port.empty()) throw std::runtime_error("no --port given; see calibrate_imu --help");
  if (options.source.protocol == "angles") {
    throw std::runtime_error(
        "only raw modules and phones can be calibrated: the angle module does it itself");
  }
  options.source.finish();
  return true;
}

struct Collected {
  std::vector<Eigen::Vector3d> accelerations, fields;
};

/// One pass over the stream: rest, then turns.
Collected collect(const Options& options, imu::GyroCalibrator& gyro) {
  Collected collected;
  double turns_end_s = 0.0;
  const double given_up_s = serial::steadyNow_s() + options.gyro.duration_s + options.turns_s + kPatience_s;
  std::cout << "lay the module still for " << options.gyro.duration_s << " s" << std::endl;
  const auto keep_going = [&] {
    const double now_s = serial::steadyNow_s();
    if (gyro.complete() && turns_end_s == 0.0) {
      if (!gyro.result().accepted) return false;
      turns_end_s = now_s + options.turns_s;
      std::cout << gyro.result().message << "\nturn it slowly once about each axis, within "
                << options.turns_s << " s" << std::endl;
    }
    return now_s < given_up_s && (turns_end_s == 0.0 || now_s < turns_end_s);
  };
  options.source.read(keep_going, [&](const imu::ImuReading& reading) {
    const imu::RawMeasurement& raw = *reading.raw;
    if (!gyro.complete()) return gyro.add(reading.time_s, raw.angular_velocity, raw.linear_acceleration);
    if (raw.angular_velocity.norm() > kSlow_rad_s) return;
    collected.accelerations.push_back(raw.linear_acceleration);
    if (raw.magnetic_field) collected.fields.push_back(*raw.magnetic_field);
  });
  return collected;
}

bool apply(const char* name, const imu::SphereFit& fit, Eigen::Vector3d& offset, Eigen::Vector3d& scale) {
  std::cout << name << ": " << fit.message << "\n";
  if (!fit.accepted) return false;
  offset = fit.offset;
  scale = fit.scale;
  return true;
}

int run(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) return 0;
  imu::ImuCalibration calibration;
  if (std::filesystem::exists(options.output)) calibration = imu::loadCalibration(options.output);
  imu::GyroCalibrator gyro(options.gyro);
  const Collected collected = collect(options, gyro);
  if (!gyro.result().accepted) throw std::runtime_error(gyro.result().message);
  calibration.gyroscope_bias.value = gyro.result().bias;
  bool good =
      apply("accelerometer", imu::fitSphere(collected.accelerations, imu::AttitudeFilter::kGravity_m_s2),
            calibration.accelerometer_offset.value, calibration.accelerometer_scale.value);
  if (!collected.fields.empty()) {
    good = apply("magnetometer", imu::fitSphere(collected.fields, options.field_uT),
                 calibration.magnetometer_offset.value, calibration.magnetometer_scale.value) &&
           good;
  }
  imu::saveCalibration(calibration, options.output);
  std::cout << "stored in " << options.output << (good ? "" : ", without what was refused") << "\n";
  return good ? 0 : 1;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("calibrate_imu", stereo_nav::tools::run, argc, argv);
}
