#include "estimation/ekf/fusion_setup.h"

#include <algorithm>

namespace stereo_nav::estimation {
namespace {

using Kind = Measurement::Kind;

std::vector<int> fieldsOf(const SensorConfig& sensor, std::size_t first, std::size_t count) {
  std::vector<int> fields;
  for (std::size_t i = 0; i < count; ++i) {
    if (sensor.use[first + i]) fields.push_back(static_cast<int>(i));
  }
  return fields;
}

bool countsAsMotion(const SensorConfig& sensor) {
  if (sensor.type == SensorType::kOdometry && !sensor.params.absolute) return true;
  return sensor.params.differential;
}

/// Adds a channel where it has fields; -1 without.
int addChannel(const SensorConfig& sensor, Kind kind, const char* what, double gate,
               const std::vector<int>& fields, std::vector<Channel>& channels) {
  if (fields.empty()) return -1;
  Channel channel;
  channel.name = sensor.name + " (" + sensor.topic + ")" + what;
  channel.kind = kind;
  channel.gate = gate;
  channel.wheels = sensor.params.wheel_scales;
  channel.feels_gravity = sensor.params.remove_gravitational_acceleration;
  channel.reading_sigma_m = sensor.params.reading_sigma_m;
  channel.reading_sigma_rad = sensor.params.reading_sigma_rad;
  channels.push_back(channel);
  return static_cast<int>(channels.size()) - 1;
}

}  // namespace

FusionSetup setUp(const FusionConfig& config) {
  FusionSetup setup;
  for (const SensorConfig& sensor : config.sensors) {
    const bool imu = sensor.type == SensorType::kImu;
    SensorChannels own;
    own.pose_fields = fieldsOf(sensor, 0, 6);
    own.twist_fields = fieldsOf(sensor, 6, 6);
    own.acceleration_fields = fieldsOf(sensor, 12, 3);
    const bool several =
        !own.pose_fields.empty() && !(own.twist_fields.empty() && own.acceleration_fields.empty());
    own.pose = addChannel(sensor, countsAsMotion(sensor) ? Kind::kMotion : Kind::kPose,
                          imu       ? " attitude"
                          : several ? " pose"
                                    : "",
                          sensor.params.pose_rejection_threshold, own.pose_fields, setup.channels);
    own.twist = addChannel(sensor, imu ? Kind::kRate : Kind::kTwist,
                           imu       ? " gyroscope"
                           : several ? " twist"
                                     : "",
                           sensor.params.twist_rejection_threshold, own.twist_fields, setup.channels);
    own.acceleration = addChannel(sensor, Kind::kAcceleration, " accelerometer",
                                  sensor.params.linear_acceleration_rejection_threshold,
                                  own.acceleration_fields, setup.channels);
    setup.parts.wheel_scales = setup.parts.wheel_scales || sensor.params.wheel_scales;
    setup.sensors.push_back(std::move(own));
  }
  const auto has = [&setup](Kind kind) {
    return std::any_of(setup.channels.begin(), setup.channels.end(),
                       [kind](const Channel& channel) { return channel.kind == kind; });
  };
  setup.parts.planar = config.params.two_d_mode;
  setup.parts.gyro = has(Kind::kRate);
  // Beside a gyroscope the turn that wheels tell counts little, and its bias and a turn that grows with the
  // way are hard to tell apart.
  setup.parts.wheel_turns = setup.parts.wheel_scales && !setup.parts.gyro;
  setup.parts.accelerometer = has(Kind::kAcceleration);
  setup.parts.anchors =
      static_cast<int>(std::count_if(setup.channels.begin(), setup.channels.end(),
                                     [](const Channel& channel) { return channel.kind == Kind::kMotion; }));
  return setup;
}

}  // namespace stereo_nav::estimation
