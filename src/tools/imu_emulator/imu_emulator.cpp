// Behaves like an IMU module, with the faults of cables and adapters on a pseudo-terminal, or with those of a
// network.
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

#include <fstream>
#include <optional>

#include "sensors/imu/module_angles.h"
#include "sensors/serial/emulation/emulated_adapter.h"
#include "sensors/serial/steady_clock.h"
#include "tools/common/program.h"
#include "tools/imu_emulator/imu_emulator_options.h"

namespace stereo_nav::tools {
namespace {

class Emulator {
 public:
  explicit Emulator(EmulatorOptions options)
      : options_(std::move(options)),
        run_(options_.run),
        module_(options_.protocol, options_.order, options_.magnetometer, options_.errors,
                options_.run.adapter.seed),
        log_(options_.run.openLog("# steady time (s), yaw (deg), pitch (deg), roll (deg)")) {
    if (options_.udp) {
      datagrams_.emplace(*options_.udp);
    } else {
      adapter_.emplace(options_.run.adapter);
      run_.start(*adapter_);
    }
  }

  bool done() const { return run_.done(); }
  double elapsed_s() const { return run_.elapsed_s(); }

  /// Sends the frames that are due by the module's own rate.
  void sendDueFrames() {
    while (run_.sendsAt(frame_time_s_)) {
      send(options_.motion(frame_time_s_), frame_time_s_);
      frame_time_s_ = static_cast<double>(++frame_number_) / options_.rate_hz;
    }
  }

  void send(const imu::MotionState& state, double time_s) {
    if (options_.run.pause.contains(time_s)) return;
    const double at_s = run_.start_s() + time_s;
    if (adapter_ && !sent_.admits(*adapter_, at_s)) return;
    const auto frame = module_.frame(state, time_s);
    if (adapter_) adapter_->send(frame, at_s);
    if (datagrams_) sent_.add();
    if (datagrams_ && !options_.run.adapter.unplug.contains(time_s)) datagrams_->send(frame);
    if (log_.is_open()) writeLog(state, time_s);
  }

  void handOver() {
    if (adapter_) adapter_->handOver(serial::steadyNow_s());
  }

  void printCounts() const { sent_.print("frames", adapter_ ? adapter_->overrun() : 0); }

 private:
  void writeLog(const imu::MotionState& state, double time_s) {
    const imu::ModuleAngles angles = options_.protocol == imu::Protocol::kAngles
                                         ? module_.lastAngles()
                                         : imu::moduleFromOrientation(state.q_world_imu);
    log_ << run_.start_s() + time_s << "," << angles.yaw_deg << "," << angles.pitch_deg << ","
         << angles.roll_deg << "\n";
  }

  EmulatorOptions options_;
  EmulatorRun run_;
  imu::EmulatedModule module_;
  std::optional<serial::EmulatedAdapter> adapter_;
  std::optional<imu::DatagramLine> datagrams_;  ///< one of the two
  std::ofstream log_;
  double frame_time_s_ = 0.0;
  std::uint64_t frame_number_ = 0;
  SentCounter sent_;
};

void followMotion(Emulator& emulator) {
  while (!emulator.done()) {
    emulator.sendDueFrames();
    emulator.handOver();
    sleepBriefly();
  }
}

imu::MotionState stateOf(const sensor_msgs::Imu& message) {
  const auto& q = message.orientation;
  const auto& w = message.angular_velocity;
  const auto& a = message.linear_acceleration;
  return {Eigen::Quaterniond(q.w, q.x, q.y, q.z), {w.x, w.y, w.z}, {a.x, a.y, a.z}};
}

void followTopic(Emulator& emulator, const std::string& topic) {
  ros::NodeHandle handle;
  const ros::Subscriber subscriber =
      handle.subscribe<sensor_msgs::Imu>(topic, 1000, [&](const sensor_msgs::Imu::ConstPtr& message) {
        emulator.send(stateOf(*message), emulator.elapsed_s());
      });
  while (ros::ok() && !emulator.done()) {
    ros::spinOnce();
    emulator.handOver();
    sleepBriefly();
  }
}

int run(int argc, char** argv) {
  std::vector<std::string> remaining;
  ros::removeROSArgs(argc, argv, remaining);
  std::vector<char*> arguments;
  for (std::string& argument : remaining) arguments.push_back(argument.data());
  const auto options = parseEmulatorOptions(static_cast<int>(arguments.size()), arguments.data());
  if (!options) return 0;
  if (!options->follow_topic.empty()) {
    ros::init(argc, argv, "imu_emulator", ros::init_options::NoSigintHandler);
  }
  Emulator emulator(*options);
  if (options->follow_topic.empty()) {
    followMotion(emulator);
  } else {
    followTopic(emulator, options->follow_topic);
  }
  emulator.printCounts();
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("imu_emulator", stereo_nav::tools::run, argc, argv);
}
