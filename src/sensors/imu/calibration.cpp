#include "stereo_nav/sensors/imu/calibration.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::imu {
namespace {

void writeVector(std::ostream& file, const std::string& name, const Eigen::Vector3d& v) {
  file << name << ": {x: " << v.x() << ", y: " << v.y() << ", z: " << v.z() << "}\n";
}

}  // namespace

void VectorParams::describe(ParameterVisitor& visitor) {
  visitor.real("x", value.x(), {-limit, limit}, unit, "x axis of the module");
  visitor.real("y", value.y(), {-limit, limit}, unit, "y axis of the module");
  visitor.real("z", value.z(), {-limit, limit}, unit, "z axis of the module");
}

void ImuCalibration::describe(ParameterVisitor& visitor) {
  visitSection(visitor, "gyroscope_bias", gyroscope_bias);
  visitSection(visitor, "accelerometer_offset", accelerometer_offset);
  visitSection(visitor, "accelerometer_scale", accelerometer_scale);
  visitSection(visitor, "magnetometer_offset", magnetometer_offset);
  visitSection(visitor, "magnetometer_scale", magnetometer_scale);
}

InertialSample ImuCalibration::apply(const RawMeasurement& measured, double time_s) const {
  InertialSample sample;
  sample.time_s = time_s;
  sample.angular_velocity = measured.angular_velocity - gyroscope_bias.value;
  sample.linear_acceleration =
      (measured.linear_acceleration - accelerometer_offset.value).cwiseProduct(accelerometer_scale.value);
  if (measured.magnetic_field) {
    sample.magnetic_field =
        (*measured.magnetic_field - magnetometer_offset.value).cwiseProduct(magnetometer_scale.value);
  }
  return sample;
}

ImuCalibration loadCalibration(const std::string& path) {
  ImuCalibration calibration;
  readParameters(loadYamlFile(path), path, calibration);
  return calibration;
}

void saveCalibration(const ImuCalibration& calibration, const std::string& path) {
  const std::string unfinished = path + ".tmp";
  std::ofstream file(unfinished);
  file.precision(12);
  file << "# Calibration of an IMU module: calibrated = (measured - offset) * scale.\n";
  writeVector(file, "gyroscope_bias", calibration.gyroscope_bias.value);
  writeVector(file, "accelerometer_offset", calibration.accelerometer_offset.value);
  writeVector(file, "accelerometer_scale", calibration.accelerometer_scale.value);
  writeVector(file, "magnetometer_offset", calibration.magnetometer_offset.value);
  writeVector(file, "magnetometer_scale", calibration.magnetometer_scale.value);
  file.close();
  if (!file || std::rename(unfinished.c_str(), path.c_str()) != 0) {
    throw std::runtime_error("cannot write the IMU calibration to " + path + " (" + std::strerror(errno) +
                             "): does the folder exist, and may this user write there?");
  }
}

}  // namespace stereo_nav::imu
