// Behaves like a TFmini range finder, with the faults of cables and adapters, on a pseudo-terminal.
#include <algorithm>
#include <boost/program_options.hpp>
#include <cmath>
#include <fstream>
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
        random_(options.run.adapter.seed),
        log_(options.run.openLog("# steady time (s), distance (m)")) {
    run_.start(adapter_);
  }

  void run() {
    for (std::uint64_t number = 0; !run_.done();) {
      for (double time_s = 0.0; run_.sendsAt(time_s = static_cast<double>(number) / options_.rate_hz);
           ++number) {
        if (!options_.run.pause.contains(time_s)) send(time_s);
      }
      adapter_.handOver(serial::steadyNow_s());
      sleepBriefly();
    }
    sent_.print("frames", adapter_.overrun());
  }

 private:
  void send(double time_s) {
    const double at_s = run_.start_s() + time_s;
    if (!sent_.admits(adapter_, at_s)) return;
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
    if (log_.is_open()) log_ << at_s << "," << true_m << "\n";
  }

  Options options_;
  EmulatorRun run_;
  serial::EmulatedAdapter adapter_;
  std::mt19937 random_;
  std::ofstream log_;
  SentCounter sent_;
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
  return emulate<RangeEmulator>(argc, argv, parse);
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("range_emulator", stereo_nav::tools::run, argc, argv);
}
