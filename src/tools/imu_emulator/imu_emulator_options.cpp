#include "tools/imu_emulator/imu_emulator_options.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Imu.h>

#include <boost/program_options.hpp>
#include <iostream>
#include <stdexcept>

#include "ros/bag_structure.h"
#include "tools/common/command_line.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

/// Attitudes of an Imu topic; positions stay zero.
Trajectory readImuBag(const std::string& path, const std::string& topic) {
  Trajectory trajectory;
  rosbag::Bag bag;
  ros_io::openBag(bag, path);
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    const auto message = instance.instantiate<sensor_msgs::Imu>();
    if (!message || message->orientation_covariance[0] == -1.0) continue;
    StampedPose pose;
    pose.time_s = message->header.stamp.toSec();
    const auto& q = message->orientation;
    pose.T_world_body.rotate(Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized());
    if (trajectory.empty() || pose.time_s > trajectory.back().time_s) trajectory.push_back(pose);
  }
  if (trajectory.size() < 2) {
    throw std::runtime_error(path + ": no sensor_msgs/Imu with orientation on " + topic +
                             "; `rosbag info` lists its topics");
  }
  return trajectory;
}

imu::ModuleAngles anglesOf(const std::vector<double>& values, const std::string& option) {
  if (values.size() != 3) throw std::runtime_error("--" + option + " takes three numbers: yaw pitch roll");
  return {values[0], values[1], values[2]};
}

imu::Motion motionOf(const po::variables_map& values) {
  if (values.count("trajectory") != 0) {
    const auto path = values["trajectory"].as<std::string>();
    const Trajectory trajectory = readTum(path);
    if (trajectory.size() < 2)
      throw std::runtime_error(path + ": one pose is no motion; two or more are needed");
    return imu::recordedMotion(trajectory);
  }
  if (values.count("bag") != 0) {
    return imu::recordedMotion(
        readImuBag(values["bag"].as<std::string>(), values["bag-topic"].as<std::string>()));
  }
  const auto name = values["motion"].as<std::string>();
  if (name == "rates") {
    return imu::constantRates(anglesOf(values["start"].as<std::vector<double>>(), "start"),
                              anglesOf(values["rates"].as<std::vector<double>>(), "rates"));
  }
  if (name == "sway") return imu::swaying();
  if (name == "turns") return imu::slowTurns();
  if (name == "its") return imu::headerInsideFloats();
  throw std::runtime_error("--motion " + name + " is unknown; there are rates, sway, turns and its");
}

template <class Value>
Value choice(const std::string& option, const std::string& name,
             const std::vector<std::pair<std::string, Value>>& choices) {
  std::string known;
  for (const auto& entry : choices) {
    if (entry.first == name) return entry.second;
    known += " " + entry.first;
  }
  throw std::runtime_error("--" + option + " " + name + " is unknown; there are" + known);
}

po::options_description describeOptions(EmulatorOptions& o) {
  using Numbers = std::vector<double>;
  const auto triple = [](double value) {
    return po::value<Numbers>()->multitoken()->default_value({value, value, value}, "");
  };
  po::options_description visible(helpHeading(
      "usage: imu_emulator [options]",
      "Behaves like a serial IMU module on a USB adapter, on a pseudo-terminal whose path it prints."));
  visible.add_options()                                                                        //
      ("help,h", "this text")                                                                  //
      ("protocol", po::value<std::string>()->default_value("angles"), "angles, raw or phone")  //
      ("angle-order", po::value<std::string>()->default_value("yaw_pitch_roll"),
       "yaw_pitch_roll or roll_pitch_yaw")                                                     //
      ("magnetometer", po::bool_switch(&o.magnetometer), "raw: send the magnetic field, too")  //
      ("rate", po::value(&o.rate_hz)->default_value(o.rate_hz), "frames per second")           //
      ("motion", po::value<std::string>()->default_value("rates"),
       "rates (see --start, --rates), sway, turns (about each axis), its (angles whose bytes contain the frame header)")  //
      ("start", triple(0.0), "yaw pitch roll at the start, degrees")                                   //
      ("rates", triple(0.0), "yaw pitch roll, degrees per second")                                     //
      ("trajectory", po::value<std::string>(), "follow a TUM trajectory of the IMU")                   //
      ("bag", po::value<std::string>(), "follow the orientation of a recording")                       //
      ("bag-topic", po::value<std::string>()->default_value("imu/data"), "its sensor_msgs/Imu topic")  //
      ("follow-topic", po::value(&o.follow_topic), "pass on a live sensor_msgs/Imu topic")             //
      ("yaw-drift", po::value(&o.errors.yaw_drift_deg_s)->default_value(0.0),
       "degrees per second; the thesis' module: 0.00483")  //
      ("angle-noise", po::value(&o.errors.angle_noise_deg)->default_value(0.0),
       "standard deviation, degrees")  //
      ("angle-resolution", po::value(&o.errors.angle_resolution_deg)->default_value(0.0),
       "step of the angles, degrees")             //
      ("gyro-bias", triple(0.0), "x y z, rad/s")  //
      ("gyro-noise", po::value(&o.errors.gyro_noise_rad_s)->default_value(0.0),
       "standard deviation, rad/s")                          //
      ("accelerometer-offset", triple(0.0), "x y z, m/s^2")  //
      ("accelerometer-gain", triple(1.0), "x y z")           //
      ("accelerometer-noise", po::value(&o.errors.accelerometer_noise_m_s2)->default_value(0.0),
       "standard deviation, m/s^2");
  o.run.addOptions(visible);
  visible.add_options()  //
      ("udp", po::value<std::string>(),
       "udp:ADDRESS:PORT or udp:PORT of this computer: send datagrams there instead; of the faults there are --corrupt, "
       "--drop (share of datagrams) and the next two")  //
      ("overtaken", po::value<double>()->default_value(0.0),
       "share of datagrams that arrive behind their successor")  //
      ("doubled", po::value<double>()->default_value(0.0), "share of datagrams that arrive twice");
  return visible;
}

Eigen::Vector3d vectorOf(const po::variables_map& values, const std::string& option) {
  const auto& numbers = values[option].as<std::vector<double>>();
  if (numbers.size() != 3) throw std::runtime_error("--" + option + " takes three numbers: x y z");
  return {numbers[0], numbers[1], numbers[2]};
}

imu::DatagramOptions datagramsOf(const po::variables_map& values, const serial::AdapterOptions& faults) {
  const auto target = imu::parseUdpAddress(values["udp"].as<std::string>());
  if (!target) throw std::runtime_error("--udp takes udp:PORT or udp:ADDRESS:PORT");
  imu::DatagramOptions options;
  options.target = *target;
  options.drop_probability = faults.drop_probability;
  options.corrupt_probability = faults.corrupt_probability;
  options.overtake_probability = values["overtaken"].as<double>();
  options.double_probability = values["doubled"].as<double>();
  options.seed = faults.seed;
  return options;
}

}  // namespace

std::optional<EmulatorOptions> parseEmulatorOptions(int argc, char** argv) {
  EmulatorOptions options;
  const po::options_description visible = describeOptions(options);
  po::variables_map values;
  // Negative numbers are values, not options; there are no short options but -h.
  po::store(po::command_line_parser(argc, argv)
                .options(visible)
                .style(po::command_line_style::unix_style ^ po::command_line_style::allow_short)
                .run(),
            values);
  po::notify(values);
  if (values.count("help") != 0) {
    std::cout << visible << "\n";
    return std::nullopt;
  }
  options.protocol = choice<imu::Protocol>(
      "protocol", values["protocol"].as<std::string>(),
      {{"angles", imu::Protocol::kAngles}, {"raw", imu::Protocol::kRaw}, {"phone", imu::Protocol::kPhone}});
  options.order = choice<imu::AngleOrder>("angle-order", values["angle-order"].as<std::string>(),
                                          {{"yaw_pitch_roll", imu::AngleOrder::kYawPitchRoll},
                                           {"roll_pitch_yaw", imu::AngleOrder::kRollPitchYaw}});
  options.errors.gyro_bias = vectorOf(values, "gyro-bias");
  options.errors.accelerometer_offset = vectorOf(values, "accelerometer-offset");
  options.errors.accelerometer_gain = vectorOf(values, "accelerometer-gain");
  if (!(options.rate_hz > 0.0)) throw std::runtime_error("--rate must be above 0");
  options.run.check();
  if (values.count("udp") != 0) options.udp = datagramsOf(values, options.run.adapter);
  if (options.protocol == imu::Protocol::kPhone && !options.udp) {
    throw std::runtime_error("a phone sends UDP: --udp udp:5555 says where to");
  }
  if (options.follow_topic.empty()) options.motion = motionOf(values);
  return options;
}

}  // namespace stereo_nav::tools
