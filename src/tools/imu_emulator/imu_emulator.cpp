// Behaves like a serial IMU module, with the faults of cables and adapters, on a pseudo-terminal.
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iostream>
#include <memory>
#include <random>
#include <thread>

#include "sensors/imu/imu_device.h"
#include "sensors/serial/emulation/pseudo_terminal.h"
#include "sensors/serial/emulation/serial_line.h"
#include "sensors/serial/steady_clock.h"
#include "tools/common/program.h"
#include "tools/imu_emulator/imu_emulator_options.h"

namespace stereo_nav::tools {
namespace {

volatile std::sig_atomic_t interrupted = 0;

/// The longest time that a frame waits for the line; a module whose line is too slow leaves frames out.
constexpr double kMaxBacklog_s = 0.005;

/// How long the port stays after the last frame, so that the last frame can be read.
constexpr double kLinger_s = 1.0;
/// A pseudo-terminal holds less than the kernel does for a real serial port; this makes up for it.
constexpr std::size_t kKernelBuffer = 65536;

class Emulator {
 public:
  explicit Emulator(EmulatorOptions options)
      : options_(std::move(options)),
        module_(options_.protocol, options_.order, options_.magnetometer, options_.errors, options_.seed),
        faults_(options_.corrupt_probability, options_.drop_probability, options_.seed + 1),
        random_(options_.seed + 2),
        line_(options_.baud_rate, options_.batch_s),
        start_s_(serial::steadyNow_s()) {
    if (!options_.log.empty()) {
      log_.open(options_.log);
      log_.precision(17);
      log_ << "# steady time (s), yaw (deg), pitch (deg), roll (deg)\n";
    }
    plugIn();
  }

  bool done() const {
    return interrupted != 0 || (options_.duration_s > 0.0 && elapsed_s() > options_.duration_s + kLinger_s);
  }

  /// Sends the frames that are due by the module's own rate.
  void sendDueFrames() {
    const double end_s = options_.duration_s > 0.0 ? options_.duration_s : 1e18;
    while (frame_time_s_ <= elapsed_s() && frame_time_s_ < end_s) {
      send(options_.motion(frame_time_s_), frame_time_s_);
      frame_time_s_ = static_cast<double>(++frame_number_) / options_.rate_hz;
    }
  }

  void send(const imu::MotionState& state, double time_s) {
    if (options_.pause.contains(time_s)) return;
    if (line_.backlog_s(start_s_ + time_s) > kMaxBacklog_s) {
      ++left_out_;
      return;
    }
    const auto frame = module_.frame(state, time_s);
    std::vector<std::uint8_t> bytes;
    faults_.pass(frame.data(), frame.size(), bytes);
    if (std::uniform_real_distribution<double>()(random_) < options_.garbage_probability) {
      for (int i = 0; i < 20; ++i) bytes.push_back(static_cast<std::uint8_t>(random_()));
    }
    line_.send(bytes, start_s_ + time_s);
    ++sent_;
    if (log_.is_open()) writeLog(state, time_s);
  }

  /// Hands over what the adapter has, to whoever reads at whatever baud rate, and plugs as scheduled.
  void handOver() {
    if (options_.unplug.contains(elapsed_s())) {
      terminal_.reset();
    } else if (!terminal_) {
      if (!options_.replug_link.empty() && !options_.links.empty()) options_.links[0] = options_.replug_link;
      plugIn();
    }
    std::vector<std::uint8_t> bytes;
    line_.collect(serial::steadyNow_s(), bytes);
    if (!terminal_) {
      kernel_buffer_.clear();
      return;
    }
    if (!bytes.empty()) bytes = asReceived(bytes);
    kernel_buffer_.insert(kernel_buffer_.end(), bytes.begin(), bytes.end());
    const std::size_t taken = terminal_->write(kernel_buffer_);
    kernel_buffer_.erase(kernel_buffer_.begin(), kernel_buffer_.begin() + static_cast<std::ptrdiff_t>(taken));
    if (kernel_buffer_.size() > kKernelBuffer) {
      overrun_ += kernel_buffer_.size() - kKernelBuffer;
      kernel_buffer_.resize(kKernelBuffer);
    }
  }

  void printCounts() const {
    std::cout << "sent " << sent_ << " frames";
    if (left_out_ > 0) std::cout << ", left out " << left_out_ << ": the line is too slow for this rate";
    if (overrun_ > 0) std::cout << ", " << overrun_ << " bytes lost: nobody read them";
    std::cout << std::endl;
  }

  /// The module is switched on when its port is opened.
  void waitForReader() {
    while (interrupted == 0 && !terminal_->baudRate()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    start_s_ = serial::steadyNow_s();
  }

  double elapsed_s() const { return serial::steadyNow_s() - start_s_; }

 private:
  void plugIn() {
    terminal_ = std::make_unique<serial::PseudoTerminal>();
    for (const std::string& link : options_.links) terminal_->link(link);
    std::cout << "port " << terminal_->path() << std::endl;
  }

  std::vector<std::uint8_t> asReceived(const std::vector<std::uint8_t>& bytes) {
    const int reader_baud = terminal_->baudRate().value_or(options_.baud_rate);
    if (reader_baud == options_.baud_rate) return bytes;
    if (!receiver_ || receiver_baud_ != reader_baud) {
      receiver_ = std::make_unique<serial::MismatchedReceiver>(options_.baud_rate, reader_baud);
      receiver_baud_ = reader_baud;
    }
    std::vector<std::uint8_t> received;
    receiver_->receive(bytes, received);
    return received;
  }

  void writeLog(const imu::MotionState& state, double time_s) {
    const imu::ModuleAngles angles = options_.protocol == imu::Protocol::kAngles
                                         ? module_.lastAngles()
                                         : imu::moduleFromOrientation(state.q_world_imu);
    log_ << start_s_ + time_s << "," << angles.yaw_deg << "," << angles.pitch_deg << "," << angles.roll_deg
         << "\n";
  }

  EmulatorOptions options_;
  imu::EmulatedModule module_;
  serial::LineFaults faults_;
  std::mt19937 random_;
  serial::SerialLine line_;
  std::unique_ptr<serial::MismatchedReceiver> receiver_;
  int receiver_baud_ = 0;
  std::unique_ptr<serial::PseudoTerminal> terminal_;
  std::ofstream log_;
  double start_s_;
  double frame_time_s_ = 0.0;
  std::uint64_t frame_number_ = 0, sent_ = 0, left_out_ = 0, overrun_ = 0;
  std::vector<std::uint8_t> kernel_buffer_;
};

void sleepBriefly() {
  std::this_thread::sleep_for(std::chrono::microseconds(500));
}

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
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
  Emulator emulator(*options);
  if (options->wait_for_reader) emulator.waitForReader();
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
