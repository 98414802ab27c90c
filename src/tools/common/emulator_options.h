#pragma once

#include <boost/program_options.hpp>
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

}  // namespace stereo_nav::tools
