#pragma once

#include <boost/program_options.hpp>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "sensors/serial/emulation/emulated_adapter.h"

namespace stereo_nav::tools {

/// What every emulator of a module on a serial port can do.
struct EmulatorRunOptions {
  serial::AdapterOptions adapter;
  double duration_s = 0.0;       ///< 0: until interrupted
  bool wait_for_reader = false;  ///< begin when the port is opened
  std::string log;               ///< CSV of what was sent; empty: none
  serial::Interval pause;        ///< the module falls silent

  void addOptions(boost::program_options::options_description& options);
  /// To be called after parsing. Throws std::runtime_error.
  void check() const;
  /// The file `log`, with `heading` as its first line; closed where there is none.
  std::ofstream openLog(const std::string& heading) const;
};

/// Counts what was sent, and what was not since the line is too slow for it.
class SentCounter {
 public:
  /// Whether something that is due at `at_s` is sent: it waits for the line for 5 ms at most.
  bool admits(const serial::EmulatedAdapter& adapter, double at_s);
  /// Counts what goes another way than by an adapter.
  void add() { ++sent_; }
  /// `what`: frames, samples. `overrun`: bytes that nobody read.
  void print(const std::string& what, std::uint64_t overrun) const;

 private:
  std::uint64_t sent_ = 0, left_out_ = 0;
};

/// The clock of an emulator, and its end: by --duration or by a signal.
class EmulatorRun {
 public:
  /// Handles SIGINT and SIGTERM from now on.
  explicit EmulatorRun(const EmulatorRunOptions& options);

  /// Waits for a reader if told to, and sets the clock to zero.
  void start(serial::EmulatedAdapter& adapter);
  /// Seconds since start().
  double elapsed_s() const;
  double start_s() const { return start_s_; }
  /// Whether the module still sends what is due at `time_s`.
  bool sendsAt(double time_s) const { return time_s <= elapsed_s() && time_s < end_s_; }
  /// After the last frame the port stays for a second, so that it can be read.
  bool done() const;

 private:
  bool wait_for_reader_;
  double end_s_;
  double start_s_;
};

/// The arguments without those of roslaunch, `__name:=...` and the like, which an emulator that is no node
/// does not use.
std::vector<char*> withoutRosArguments(int argc, char** argv);

/// Lets other programs run until something may be due.
void sleepBriefly();

/// run() of an emulator that is no node. `parse` returns false where only help was asked for.
template <class Emulator, class Options>
int emulate(int argc, char** argv, bool (*parse)(int, char**, Options&)) {
  Options options;
  std::vector<char*> arguments = withoutRosArguments(argc, argv);
  if (!parse(static_cast<int>(arguments.size()), arguments.data(), options)) return 0;
  Emulator(options).run();
  return 0;
}

}  // namespace stereo_nav::tools
