#include "estimation/ekf/fusion_config.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <regex>

#include "stereo_nav/core/parameters.h"

namespace stereo_nav::estimation {
namespace {

using Vector15d = Eigen::Matrix<double, 15, 1>;

/// Parameters of robot_localization without an equal: the reason, and the value at which nothing is missed.
struct WithoutEqual {
  const char* reason;
  const char* harmless;
};

const std::map<std::string, WithoutEqual>& withoutEqual() {
  static const char* const kCommands =
      "commands are no measurements: the filter predicts by velocities and their noise (acceleration_noise)";
  static const char* const kMatrices =
      "the noise follows from what the sensors state and from their innovations";
  static const std::map<std::string, WithoutEqual> kNames = {
      {"use_control", {kCommands, "false"}},
      {"stamped_control", {kCommands, "false"}},
      {"control_timeout", {kCommands, ""}},
      {"control_config", {kCommands, ""}},
      {"acceleration_limits", {kCommands, ""}},
      {"deceleration_limits", {kCommands, ""}},
      {"acceleration_gains", {kCommands, ""}},
      {"deceleration_gains", {kCommands, ""}},
      {"dynamic_process_noise_covariance", {kMatrices, "false"}},
      {"permit_corrected_publication",
       {"each stamp is published once; late measurements change the poses that follow", "false"}},
      {"print_diagnostics", {"diagnostics are always published", "true"}},
      {"debug", {"rosrun stereo_nav fuse shows what each sensor contributes", "false"}},
      {"debug_out_file", {"rosrun stereo_nav fuse shows what each sensor contributes", ""}},
      {"transform_timeout", {"messages without a transform are left out and said, never waited for", "0.0"}},
      {"silent_tf_failure", {"a missing transform is said once", "false"}},
      {"alpha", {"belongs to the unscented filter", ""}},
      {"beta", {"belongs to the unscented filter", ""}},
      {"kappa", {"belongs to the unscented filter", ""}},
  };
  return kNames;
}

/// A list of so many numbers.
std::vector<double> readNumbers(const YAML::Node& node, std::size_t length, const std::string& name,
                                const std::string& source) {
  if (!node.IsSequence() || node.size() != length)
    throw ParameterError(fmt::format("{}: {} must be a list of {} numbers, it has {}{}", source, name, length,
                                     node.IsSequence() ? node.size() : 0,
                                     length == 225 ? " (15 rows of 15; published files have had 255)" : ""));
  std::vector<double> numbers;
  try {
    for (const YAML::Node& item : node) numbers.push_back(item.as<double>());
  } catch (const YAML::Exception&) {
    throw ParameterError(source + ": " + name + " holds something that is no number");
  }
  return numbers;
}

/// The diagonal of a 15x15 matrix; what lies beside it must be small against it.
Vector15d readDiagonal(const YAML::Node& node, const std::string& name, const std::string& source,
                       std::vector<std::string>& notes) {
  const std::vector<double> numbers = readNumbers(node, 225, name, source);
  Vector15d diagonal;
  bool beside = false;
  for (std::size_t i = 0; i < 15; ++i) {
    for (std::size_t j = 0; j < 15; ++j) beside = beside || (i != j && numbers[15 * i + j] != 0.0);
    diagonal[static_cast<Eigen::Index>(i)] = numbers[16 * i];
    if (!(numbers[16 * i] >= 0.0 && numbers[16 * i] < 1e12))
      throw ParameterError(fmt::format("{}: {} has the variance {:g} in row {}; variances are 0 or larger",
                                       source, name, numbers[16 * i], i + 1));
  }
  if (beside) notes.push_back(name + ": only the diagonal is used");
  return diagonal;
}

std::array<bool, 15> readUse(const YAML::Node& node, const std::string& name, const std::string& source) {
  std::array<bool, 15> use{};
  if (!node.IsSequence() || node.size() != use.size())
    throw ParameterError(fmt::format("{}: {} must be a list of 15 times true or false, it has {}", source,
                                     name, node.IsSequence() ? node.size() : 0));
  try {
    for (std::size_t i = 0; i < use.size(); ++i) use[i] = node[i].as<bool>();
  } catch (const YAML::Exception&) {
    throw ParameterError(source + ": " + name + " holds something that is neither true nor false");
  }
  return use;
}

SensorType typeOf(const std::string& word) {
  if (word == "odom") return SensorType::kOdometry;
  if (word == "pose") return SensorType::kPose;
  if (word == "twist") return SensorType::kTwist;
  return word == "imu" ? SensorType::kImu : SensorType::kFix;
}

/// The parts of a file, told apart by their names.
class FileReader {
 public:
  FileReader(const YAML::Node& file, std::string source) : source_(std::move(source)) {
    if (file.IsDefined() && !file.IsNull() && !file.IsMap())
      throw ParameterError(source_ + ": the file must be a list of `name: value` lines");
    for (const auto& entry : file) sort(entry.first.as<std::string>(), entry.second);
  }

  FusionConfig read() {
    readParameters(scalars_, source_, config_.params);
    for (const auto& [name, values] : sensors_) readSensor(name, values);
    checkWhole();
    return config_;
  }

 private:
  void sort(const std::string& name, const YAML::Node& value) {
    static const std::regex kSensor("(odom|pose|twist|imu|fix)([0-9]+)(_(.+))?");
    std::smatch match;
    const auto missing = withoutEqual().find(name);
    FilterParams& filter = config_.params.filter;
    if (std::regex_match(name, match, kSensor)) {
      sensors_[match[1].str() + match[2].str()][match[4].str()] = value;
    } else if (name == "process_noise_covariance") {
      filter.process_noise = readDiagonal(value, name, source_, config_.notes);
    } else if (name == "initial_estimate_covariance") {
      filter.initial_variance = readDiagonal(value, name, source_, config_.notes);
    } else if (name == "initial_state") {
      const std::vector<double> numbers = readNumbers(value, 15, name, source_);
      filter.initial_state = Eigen::Map<const Vector15d>(numbers.data());
    } else if (missing != withoutEqual().end()) {
      const std::string text = value.IsScalar() ? value.Scalar() : "";
      if (text.empty() || text != missing->second.harmless)
        config_.notes.push_back(name + " has no equal here: " + missing->second.reason);
    } else {
      scalars_[name] = value;
    }
  }

  void readSensor(const std::string& name, std::map<std::string, YAML::Node> values) {
    SensorConfig sensor;
    sensor.name = name;
    sensor.type = typeOf(name.substr(0, name.find_first_of("0123456789")));
    if (values.count("") == 0)
      throw ParameterError(
          fmt::format("{}: {} names no topic; there are parameters {}_*, but no line `{}: TOPIC`", source_,
                      name, name, name));
    sensor.topic = values[""].as<std::string>("");
    if (sensor.type == SensorType::kFix) {
      sensor.use = {true, true, !config_.params.two_d_mode};
    } else if (values.count("config") == 0) {
      throw ParameterError(
          fmt::format("{}: {}_config is missing, the list of what {} is used for", source_, name, name));
    }
    if (values.count("config") > 0) sensor.use = readUse(values["config"], name + "_config", source_);
    YAML::Node rest(YAML::NodeType::Map);
    for (const auto& [key, value] : values) {
      if (!key.empty() && key != "config") rest[key] = value;
    }
    readParameters(rest, source_ + ": " + name + "_...", sensor.params);
    explain(sensor);
    config_.sensors.push_back(sensor);
  }

  bool uses(const SensorConfig& sensor, std::size_t from, std::size_t to) const {
    for (std::size_t i = from; i < to; ++i) {
      if (sensor.use[i]) return true;
    }
    return false;
  }

  void leaveOut(SensorConfig& sensor, std::size_t from, std::size_t to, const char* what) {
    if (!uses(sensor, from, to)) return;
    for (std::size_t i = from; i < to; ++i) sensor.use[i] = false;
    config_.notes.push_back(
        fmt::format("{}_config asks for {}, which its messages do not hold", sensor.name, what));
  }

  void explain(SensorConfig& sensor) {
    const bool imu = sensor.type == SensorType::kImu;
    if (imu) leaveOut(sensor, 0, 3, "a position");
    if (imu) leaveOut(sensor, 6, 9, "velocities");
    if (!imu) leaveOut(sensor, 12, 15, "accelerations");
    if (sensor.type == SensorType::kTwist) leaveOut(sensor, 0, 6, "a pose");
    if (sensor.type == SensorType::kPose) leaveOut(sensor, 6, 12, "velocities");
    if (sensor.type == SensorType::kFix) leaveOut(sensor, 3, 12, "an attitude or velocities");
    if (sensor.type == SensorType::kOdometry && !sensor.params.absolute) explainOdometry(sensor);
    if (imu && sensor.use[5] && !sensor.params.differential)
      config_.notes.push_back(sensor.name +
                              "_config takes the IMU's yaw: magnetic fields bend it indoors; vyaw alone, "
                              "whose bias is estimated, is mostly better");
  }

  void explainOdometry(SensorConfig& sensor) {
    if (!uses(sensor, 0, 6)) return;
    if (!sensor.params.differential)
      config_.notes.push_back(
          fmt::format("of the poses of {} only the motions count, as with {}_differential: true; "
                      "{}_absolute: true takes them as poses in world_frame",
                      sensor.name, sensor.name, sensor.name));
    for (std::size_t i = 0; i < 6; ++i) {
      if (!sensor.use[i] || !sensor.use[i + 6]) continue;
      sensor.use[i + 6] = false;
      config_.notes.push_back(
          fmt::format("{}: entry {} of its config is left out, since the motions of its pose say the "
                      "same: both would count each error twice",
                      sensor.name, i + 7));
    }
  }

  void checkWhole() const {
    const FusionParams& params = config_.params;
    if (params.world_frame != params.map_frame && params.world_frame != params.odom_frame)
      throw ParameterError(
          fmt::format("{}: world_frame is '{}', allowed is map_frame ('{}') or odom_frame ('{}')", source_,
                      params.world_frame, params.map_frame, params.odom_frame));
    if (config_.sensors.empty())
      throw ParameterError(
          source_ + ": no sensor; at least one line such as `odom0: wheel/odom` with its odom0_config");
    std::string wheels;
    for (const SensorConfig& sensor : config_.sensors) {
      if (!sensor.params.wheel_scales) continue;
      if (!wheels.empty())
        throw ParameterError(
            fmt::format("{}: {} and {} both have wheel_scales: true; the scales are those of one sensor",
                        source_, wheels, sensor.name));
      wheels = sensor.name;
    }
  }

  std::string source_;
  FusionConfig config_;
  YAML::Node scalars_{YAML::NodeType::Map};
  std::map<std::string, std::map<std::string, YAML::Node>> sensors_;
};

}  // namespace

FusionConfig readFusionConfig(const YAML::Node& file, const std::string& source) {
  return FileReader(file, source).read();
}

}  // namespace stereo_nav::estimation
