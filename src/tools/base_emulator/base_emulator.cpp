// Behaves like the microcontroller of a base with its wheels, with the faults of cables and adapters, on a
// pseudo-terminal.

#include <cmath>
#include <fstream>
#include <stdexcept>

#include "kinematics/drive_file.h"
#include "ros/base_bridge_params.h"
#include "sensors/base/emulation/emulated_base.h"
#include "sensors/serial/emulation/emulated_adapter.h"
#include "sensors/serial/steady_clock.h"
#include "stereo_nav/core/parameters.h"
#include "tools/common/command_line.h"
#include "tools/common/emulator_options.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

namespace po = boost::program_options;

struct Options {
  EmulatorRunOptions run;
  std::string rig;
  base::EmulatedWheelParams wheel;
  double range_m = 2.0;
  double battery_V = 12.4;
  unsigned switches = 0;
  double rate_hz = 100.0;
};

/// False when only help was asked for.
bool parse(int argc, char** argv, Options& o) {
  o.run.adapter.baud_rate = base::BaseDeviceParams().baud_rate;
  po::options_description visible(helpHeading(
      "usage: base_emulator --rig FILE [options]",
      "Behaves like the microcontroller of the base that the rig file describes (sections drive and base), with motors, "
      "encoders and steering axes, on a pseudo-terminal whose path it prints. It runs the code of the firmware."));
  visible.add_options()                                                                                    //
      ("help,h", "this text")                                                                              //
      ("rig", po::value(&o.rig), "rig file")                                                               //
      ("rate", numberOption(o.rate_hz), "periods of the loops and frames per second")                      //
      ("full-speed", numberOption(o.wheel.full_speed_m_per_s), "speed of a wheel at full duty, m/s")       //
      ("acceleration", numberOption(o.wheel.max_acceleration_m_per_s2), "what the tyres transmit, m/s^2")  //
      ("lag", numberOption(o.wheel.lag_s), "time constant of the motors, s")                               //
      ("range", numberOption(o.range_m), "what all range finders see, m; above 60: nothing")               //
      ("battery", numberOption(o.battery_V), "voltage of the battery, V")                                  //
      ("switches", po::value(&o.switches)->default_value(0), "bits of the pressed switches");
  o.run.addOptions(visible);
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "", values)) return false;
  if (o.rig.empty())
    throw std::runtime_error("--rig is missing; it is the path of a rig file with a section drive");
  if (!(o.rate_hz > 0.0) || !(o.wheel.lag_s > 0.0) || !(o.wheel.full_speed_m_per_s > 0.0))
    throw std::runtime_error("--rate, --lag and --full-speed must be above 0");
  o.run.check();
  return true;
}

base::EmulatedBaseParams describeBase(const Options& options) {
  const RigFile rig = RigFile::load(options.rig);
  const kinematics::DriveParams drive = kinematics::readDrive(rig);
  ros_io::BaseBridgeParams bridge;
  readParameters(rig.section(rig_sections::kBase), rig.sectionName(rig_sections::kBase), bridge);
  if (drive.wheels.size() > base::kMaxWheels)
    throw std::runtime_error(options.rig + ": more wheels than the protocol carries, which is " +
                             std::to_string(base::kMaxWheels));
  base::EmulatedBaseParams params;
  for (const auto& wheel : drive.wheels) {
    base::EmulatedWheelParams emulated = options.wheel;
    emulated.steered = wheel.kind == kinematics::WheelKind::kSteered;
    emulated.metres_per_pulse = wheel.metresPerPulse();
    params.wheels.push_back(emulated);
  }
  params.joints = static_cast<int>(bridge.joints.size());
  params.actuators = static_cast<int>(bridge.actuators.size());
  const auto range_mm = options.range_m > 60.0
                            ? base::kRangeNothing
                            : static_cast<std::uint16_t>(std::lround(1e3 * options.range_m));
  params.ranges_mm.assign(bridge.ranges.size(), range_mm);
  params.switches = static_cast<std::uint16_t>(options.switches);
  params.battery_mV = static_cast<std::uint16_t>(std::lround(1e3 * options.battery_V));
  params.period_s = 1.0 / options.rate_hz;
  return params;
}

class Emulator {
 public:
  explicit Emulator(const Options& options)
      : options_(options),
        base_(describeBase(options)),
        adapter_(options.run.adapter),
        faults_(options.run.adapter.corrupt_probability, options.run.adapter.drop_probability,
                options.run.adapter.seed + 3),
        run_(options.run),
        log_(options.run.openLog(
            "# steady time (s), mode, for each wheel: held speed (m/s), speed (m/s), way (m)")) {
    run_.start(adapter_);
  }

  void run() {
    while (!run_.done()) {
      std::vector<std::uint8_t> commands;
      const auto received = adapter_.received();
      faults_.pass(received.data(), received.size(), commands);
      for (const std::uint8_t byte : commands) base_.receive(byte);
      base_.advance(run_.elapsed_s(), [this](const std::vector<std::uint8_t>& frame, double time_s) {
        if (!options_.run.pause.contains(time_s)) adapter_.send(frame, run_.start_s() + time_s);
        sent_.add();
        if (log_.is_open()) writeLog(time_s);
      });
      adapter_.handOver(serial::steadyNow_s());
      sleepBriefly();
    }
    sent_.print("frames", adapter_.overrun());
  }

 private:
  void writeLog(double time_s) {
    log_ << run_.start_s() + time_s << "," << static_cast<int>(base_.controller().mode());
    for (std::size_t i = 0; i < base_.wheels().size(); ++i) {
      const auto& wheel = base_.wheels()[i];
      log_ << "," << 1e-3 * base_.controller().heldSpeed_mm_per_s(static_cast<std::uint8_t>(i)) << ","
           << wheel.speed_m_per_s() << "," << wheel.way_m();
    }
    log_ << std::endl;  // so that who measures sees it at once
  }

  Options options_;
  base::EmulatedBase base_;
  serial::EmulatedAdapter adapter_;
  serial::LineFaults faults_;
  EmulatorRun run_;
  std::ofstream log_;
  SentCounter sent_;
};

int run(int argc, char** argv) {
  return emulate<Emulator>(argc, argv, parse);
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("base_emulator", stereo_nav::tools::run, argc, argv);
}
