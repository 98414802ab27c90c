// Behaves like an RPLiDAR A1, with the faults of cables and adapters, on a pseudo-terminal.
#include <boost/program_options.hpp>
#include <fstream>
#include <vector>

#include "sensors/laser/emulation/emulated_scanner.h"
#include "sensors/serial/emulation/emulated_adapter.h"
#include "sensors/serial/steady_clock.h"
#include "tools/common/command_line.h"
#include "tools/common/emulator_options.h"
#include "tools/common/program.h"

namespace stereo_nav::tools {
namespace {

struct Options {
  laser::ScannerOptions scanner;
  EmulatorRunOptions run;
};

class LaserEmulator {
 public:
  explicit LaserEmulator(const Options& options)
      : options_(options),
        run_(options.run),
        scanner_(options.scanner),
        adapter_(options.run.adapter),
        log_(options.run.openLog("# steady time (s), heading (deg, clockwise), distance (m)")) {
    run_.start(adapter_);
  }

  void run() {
    while (!run_.done()) {
      const double now_s = run_.elapsed_s();
      send(scanner_.receive(adapter_.received(), now_s));
      for (const auto& node : scanner_.advance(now_s)) {
        if (run_.sendsAt(node.time_s)) sendNode(node);
      }
      adapter_.handOver(serial::steadyNow_s());
      sleepBriefly();
    }
    sent_.print("samples", adapter_.overrun());
  }

 private:
  void send(const std::vector<laser::EmulatedScanner::Output>& replies) {
    for (const auto& reply : replies) adapter_.send(reply.bytes, run_.start_s() + reply.time_s);
  }

  void sendNode(const laser::EmulatedScanner::Output& node) {
    if (options_.run.pause.contains(node.time_s)) return;
    const double time_s = run_.start_s() + node.time_s;
    if (!sent_.admits(adapter_, time_s)) return;
    adapter_.send(node.bytes, time_s);
    if (!log_.is_open()) return;
    const double heading_deg = scanner_.heading_deg(node.time_s);
    log_ << time_s << "," << heading_deg << "," << scanner_.distance_m(heading_deg) << "\n";
  }

  Options options_;
  EmulatorRun run_;
  laser::EmulatedScanner scanner_;
  serial::EmulatedAdapter adapter_;
  std::ofstream log_;
  SentCounter sent_;
};

bool parse(int argc, char** argv, Options& o) {
  namespace po = boost::program_options;
  po::options_description visible(helpHeading(
      "usage: laser_emulator [options]",
      "Behaves like an RPLiDAR A1 in the middle of a rectangular room, on a pseudo-terminal whose path it "
      "prints. It cannot see the line DTR, by which the real adapter switches the motor: its head "
      "always turns."));
  visible.add_options()                                                                                //
      ("help,h", "this text")                                                                          //
      ("rate", numberOption(o.scanner.sample_rate_hz), "samples per second; 115200 baud carry 2304")   //
      ("scan-rate", numberOption(o.scanner.scan_rate_hz), "revolutions per second")                    //
      ("length", numberOption(o.scanner.room_length_m), "of the room, along the scanner's x axis, m")  //
      ("width", numberOption(o.scanner.room_width_m), "of the room, m")                                //
      ("noise", numberOption(o.scanner.noise_m), "standard deviation of a distance, m")                //
      ("missing", numberOption(o.scanner.missing_share), "share of samples without a distance")        //
      ("error-code", po::value(&o.scanner.error_code)->default_value(0),
       "other than 0: the scanner has stopped itself for this reason, until it is reset");
  o.run.addOptions(visible);
  po::variables_map values;
  if (!parseCommandLine(argc, argv, visible, "", values)) return false;
  o.run.check();
  o.scanner.seed = o.run.adapter.seed;
  if (!(o.scanner.sample_rate_hz > 0.0) || !(o.scanner.scan_rate_hz > 0.0)) {
    throw std::runtime_error("--rate and --scan-rate must be above 0");
  }
  return true;
}

int run(int argc, char** argv) {
  return emulate<LaserEmulator>(argc, argv, parse);
}

}  // namespace
}  // namespace stereo_nav::tools

int main(int argc, char** argv) {
  return stereo_nav::tools::runProgram("laser_emulator", stereo_nav::tools::run, argc, argv);
}
