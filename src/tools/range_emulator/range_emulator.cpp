// Behaves like a TFmini range finder, with the faults of cables and adapters, on a pseudo-terminal.
#include <algorithm>
#include <boost/program_options.hpp>
#include <cmath>
#include <fstream>
#include <iostream>
#include <random>
#include <vector>

#include "sensors/range/tfmini_protocol.h"
#include "sensors/serial/emulation/emulated_adapter.h"
#include "sensors/serial/steady_clock.h"
#include "tools/common/command_line.h"
#include "tools/common/emulator_options.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

/// The longest time that a frame waits for the line; a module whose line is too slow leaves frames out.
constexpr double kMaxBacklog_s = 0.005;
constexpr std::uint16_t kTemperature = (256 + 40) * 8;

struct Options {
  EmulatorRunOptions run;
  double rate_hz = 100.0;
  double distance_m = 2.0;
  double amplitude_m = 0.0;
  double period_s = 10.0;
  double noise_m = 0.0;
  int strength = 1000;
};

class RangeEmulator {
 public:
  explicit RangeEmulator(const Options& options)
      : options_(options),
        run_(options.run),
        adapter_(options.run.adapter),
        random_(options.run.adapter.seed) {
    if (!options_.run.log.empty()) {
      log_.open(options_.run.log);
      log_.precision(17);
      log_ << "# steady time (s), distance (m)\n";
    }
    run_.start(adapter_);
  }

  void work() {
    for (std::uint64_t number = 0; !run_.done();) {
      for (double time_s = 0.0; run_.sendsAt(time_s = static_cast<double>(number) / options_.rate_hz);
           ++number) {
        if (!options_.run.pause.contains(time_s)) send(time_s);
      }
      adapter_.handOver(serial::steadyNow_s());
      sleepBriefly();
    }
  }

  void printCounts() const {
    std::cout << "sent " << sent_ << " frames";
    if (left_out_ > 0) std::cout << ", left out " << left_out_ << ": the line is too slow for this rate";
    if (adapter_.overrun() > 0) std::cout << ", " << adapter_.overrun() << " bytes lost: nobody read them";
    std::cout << std::endl;
  }

 private:
  void send(double time_s) {
    const double at_s = run_.start_s() + time_s;
    if (adapter_.backlog_s(at_s) > kMaxBacklog_s) {
      ++left_out_;
      return;
    }
    const double true_m =
        options_.distance_m + options_.amplitude_m * std::sin(2.0 * M_PI * time_s / options_.period_s);
    const double measured_m = true_m + options_.noise_m * std::normal_distribution<double>()(random_);
    range::TfminiMeasurement measurement;
    measurement.distance_cm = static_cast<std::uint16_t>(
        std::clamp(std::lround(100.0 * measured_m), 0L, long{range::tfmini::kMaxDistance_cm}));
    measurement.strength = static_cast<std::uint16_t>(options_.strength);
    measurement.temperature = kTemperature;
    std::vector<std::uint8_t> frame(range::tfmini::kFrameBytes);
    range::tfmini::encode(measurement, frame.data());
    adapter_.send(frame, at_s);
    ++sent_;
    if (log_.is_open()) log_ << at_s << "," << true_m << "\n";
  }

  Options options_;
  EmulatorRun run_;
  serial::EmulatedAdapter adapter_;
  std::mt19937 random_;
  std::ofstream log_;
  std::uint64_t sent_ = 0, left_out_ = 0;
};

bool parse(int argc, char** argv, Options& o) {
  namespace po = boost::program_options;
  po::options_description visible(
      helpHeading("usage: range_emulator [options]",
                  "Behaves like a TFmini range finder, on a pseudo-terminal whose path it prints."));
  visible.add_options()                                                              //
      ("help,h", "this text")                                                        //
      ("rate", numberOption(o.rate_hz), "frames per second")                         //
      ("distance", numberOption(o.distance_m), "to the wall, m")                     //
      ("amplitude", numberOption(o.amplitude_m), "by which the distance swings, m")  //
      ("period", numberOption(o.period_s), "of the swing, s")                        //
      ("noise", numberOption(o.noise_m), "standard deviation, m")                    //
      ("strength", po::value(&o.strength)->default_value(o.strength), "of the returned light, 0 to 65535");
  o.run.addOptions(visible);
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "", values)) return false;
  o.run.check();
  if (!(o.rate_hz > 0.0) || !(o.period_s > 0.0) || o.strength < 0 || o.strength > 65535) {
    throw std::runtime_error("--rate and --period must be above 0, --strength from 0 to 65535");
  }
  return true;
}

int run(int argc, char** argv) {
  Options options;
  std::vector<char*> arguments = withoutRosArguments(argc, argv);
  if (!parse(static_cast<int>(arguments.size()), arguments.data(), options)) return 0;
  RangeEmulator emulator(options);
  emulator.work();
  emulator.printCounts();
  return 0;
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("range_emulator", stereo_nav::tools::run, argc, argv);
}
