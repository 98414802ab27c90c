#include "nodes/teleop/key_driver.h"

#include <fmt/format.h>

#include <map>
#include <utility>

namespace stereo_nav::nodes {
namespace {

using kinematics::Twist;

constexpr double kFaster = 1.1;
constexpr double kSlower = 0.9;
constexpr char kFieldKey = 'f';

/// As in teleop_twist_keyboard: with the shift key the robot moves sideways instead of turning.
const std::map<char, Twist>& directions() {
  static const std::map<char, Twist> keys = {
      {'i', {1, 0, 0}}, {'o', {1, 0, -1}}, {'j', {0, 0, 1}},   {'l', {0, 0, -1}},
      {'u', {1, 0, 1}}, {',', {-1, 0, 0}}, {'.', {-1, 0, 1}},  {'m', {-1, 0, -1}},
      {'I', {1, 0, 0}}, {'O', {1, -1, 0}}, {'J', {0, 1, 0}},   {'L', {0, -1, 0}},
      {'U', {1, 1, 0}}, {'<', {-1, 0, 0}}, {'>', {-1, -1, 0}}, {'M', {-1, 1, 0}}};
  return keys;
}

/// Factors for speed and turn.
const std::map<char, std::pair<double, double>>& factors() {
  static const std::map<char, std::pair<double, double>> keys = {
      {'q', {kFaster, kFaster}}, {'z', {kSlower, kSlower}}, {'w', {kFaster, 1.0}},
      {'x', {kSlower, 1.0}},     {'e', {1.0, kFaster}},     {'c', {1.0, kSlower}}};
  return keys;
}

}  // namespace

void TeleopParams::describe(ParameterVisitor& visitor) {
  visitor.real("speed_m_per_s", speed_m_per_s, {0.0, 100.0}, "m/s", "speed at the start");
  visitor.real("turn_rad_per_s", turn_rad_per_s, {0.0, 100.0}, "rad/s", "rate of turning at the start");
  visitor.flag(
      "field_centric", field_centric,
      "forward is the x axis of the odometry's frame, wherever the robot looks; the key f changes it");
  visitor.real("repeat_delay_s", repeat_delay_s, {0.05, 3.0}, "s",
               "a first press lasts this long: the time after which the terminal repeats a key that is held");
  visitor.real("hold_s", hold_s, {0.02, 1.0}, "s",
               "the velocity is zero this long after the last repetition");
  visitor.real("rate_hz", rate_hz, {5.0, 100.0}, "Hz", "velocities while a key is held");
  visitor.real("odom_timeout_s", odom_timeout_s, {0.05, 5.0}, "s",
               "field-centric driving stops when odom is older than this");
}

KeyDriver::KeyDriver(const TeleopParams& params) : params_(params) {}

std::optional<std::string> KeyDriver::press(char key, double now_s) {
  const auto direction = directions().find(key);
  if (direction != directions().end()) {
    const bool repeated = key == last_key_ && now_s - pressed_s_ < params_.repeat_delay_s + params_.hold_s &&
                          now_s < held_until_s_;
    direction_ = direction->second;
    held_until_s_ = now_s + (repeated ? params_.hold_s : params_.repeat_delay_s);
    pressed_s_ = now_s;
    last_key_ = key;
    is_driving_ = true;
    return std::nullopt;
  }
  const auto factor = factors().find(key);
  if (factor != factors().end()) {
    params_.speed_m_per_s *= factor->second.first;
    params_.turn_rad_per_s *= factor->second.second;
    return speeds();
  }
  held_until_s_ = now_s;  // any other key stops
  last_key_ = 0;
  if (key != kFieldKey) return std::nullopt;
  params_.field_centric = !params_.field_centric;
  return speeds();
}

void KeyDriver::setHeading(double yaw_rad, double now_s) {
  yaw_rad_ = yaw_rad;
  heading_s_ = now_s;
}

bool KeyDriver::lacksHeading(double now_s) const {
  return params_.field_centric && now_s - heading_s_ > params_.odom_timeout_s;
}

std::optional<Twist> KeyDriver::velocity(double now_s) {
  if (!is_driving_) return std::nullopt;
  is_driving_ = now_s < held_until_s_;
  if (!is_driving_ || lacksHeading(now_s)) return Twist::Zero();
  const Twist twist(params_.speed_m_per_s * direction_.x(), params_.speed_m_per_s * direction_.y(),
                    params_.turn_rad_per_s * direction_.z());
  return params_.field_centric ? kinematics::fromField(twist, yaw_rad_) : twist;
}

std::string KeyDriver::speeds() const {
  return fmt::format("speed {:.2f} m/s, turn {:.2f} rad/s, {}", params_.speed_m_per_s, params_.turn_rad_per_s,
                     params_.field_centric ? "field-centric (odom)" : "as the robot looks");
}

std::string keyHelp() {
  return "Hold a key to drive; let it go to stop.\n"
         "   u  i  o      U  I  O    with shift: sideways instead of turning\n"
         "   j  k  l      J  K  L    k, space and all others: stop\n"
         "   m  ,  .      M  <  >\n"
         "q/z faster, slower   w/x speed only   e/c turn only   f field-centric   Ctrl-C ends\n";
}

}  // namespace stereo_nav::nodes
