#include "tools/common/emulator_options.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <iostream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <thread>

#include "sensors/serial/steady_clock.h"

namespace stereo_nav::tools {
namespace {

volatile std::sig_atomic_t stopped_by_signal = 0;
constexpr double kLinger_s = 1.0;

}  // namespace

void EmulatorRunOptions::addOptions(boost::program_options::options_description& options) {
  namespace po = boost::program_options;
  options.add_options()  //
      ("baud", po::value(&adapter.baud_rate)->default_value(adapter.baud_rate),
       "speed of the line; a reader that sets another one receives what it would on a wire")  //
      ("batch", po::value(&adapter.batch_s)->default_value(adapter.batch_s),
       "interval at which the adapter delivers bytes, s")                                        //
      ("duration", po::value(&duration_s)->default_value(0.0), "seconds; 0: until interrupted")  //
      ("wait-for-reader", po::bool_switch(&wait_for_reader), "begin when the port is opened")    //
      ("link", po::value(&adapter.links)->composing(),
       "name for the port, a symbolic link; may be repeated")  //
      ("replug-link", po::value(&adapter.replug_link),
       "name that replaces the first --link after the module was plugged in again")                //
      ("log", po::value(&log), "CSV file of what was sent, with its time on the steady clock")     //
      ("seed", po::value(&adapter.seed)->default_value(adapter.seed), "seed of noise and faults")  //
      ("corrupt", po::value(&adapter.corrupt_probability)->default_value(0.0),
       "share of bytes that are changed")                                                                 //
      ("drop", po::value(&adapter.drop_probability)->default_value(0.0), "share of bytes that are lost")  //
      ("garbage", po::value(&adapter.garbage_probability)->default_value(0.0),
       "share of frames that are followed by random bytes")                                     //
      ("pause-at", po::value(&pause.start_s), "second at which the module falls silent")        //
      ("pause-for", po::value(&pause.duration_s)->default_value(2.0), "seconds of silence")     //
      ("unplug-at", po::value(&adapter.unplug.start_s), "second at which the cable is pulled")  //
      ("unplug-for", po::value(&adapter.unplug.duration_s)->default_value(2.0), "seconds without the cable");
}

void EmulatorRunOptions::check() const {
  if (adapter.baud_rate <= 0 || adapter.batch_s < 0.0) {
    throw std::runtime_error("--baud must be above 0, --batch 0 or more");
  }
}

std::ofstream EmulatorRunOptions::openLog(const std::string& heading) const {
  std::ofstream file;
  if (log.empty()) return file;
  file.open(log);
  file.precision(17);
  file << heading << std::endl;
  return file;
}

bool SentCounter::admits(const serial::EmulatedAdapter& adapter, double at_s) {
  constexpr double kMaxBacklog_s = 0.005;
  const bool fits = adapter.backlog_s(at_s) <= kMaxBacklog_s;
  ++(fits ? sent_ : left_out_);
  return fits;
}

void SentCounter::print(const std::string& what, std::uint64_t overrun) const {
  std::cout << "sent " << sent_ << " " << what;
  if (left_out_ > 0) std::cout << ", left out " << left_out_ << ": the line is too slow for this rate";
  if (overrun > 0) std::cout << ", " << overrun << " bytes lost: nobody read them";
  std::cout << std::endl;
}

EmulatorRun::EmulatorRun(const EmulatorRunOptions& options)
    : wait_for_reader_(options.wait_for_reader),
      end_s_(options.duration_s > 0.0 ? options.duration_s : std::numeric_limits<double>::infinity()),
      start_s_(serial::steadyNow_s()) {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { stopped_by_signal = 1; });
}

void EmulatorRun::start(serial::EmulatedAdapter& adapter) {
  while (wait_for_reader_ && stopped_by_signal == 0 && !adapter.opened()) sleepBriefly();
  start_s_ = serial::steadyNow_s();
  adapter.start(start_s_);
}

double EmulatorRun::elapsed_s() const {
  return serial::steadyNow_s() - start_s_;
}

bool EmulatorRun::done() const {
  return stopped_by_signal != 0 || elapsed_s() > end_s_ + kLinger_s;
}

std::vector<char*> withoutRosArguments(int argc, char** argv) {
  std::vector<char*> remaining;
  std::copy_if(argv, argv + argc, std::back_inserter(remaining),
               [](const char* argument) { return std::string(argument).find(":=") == std::string::npos; });
  return remaining;
}

void sleepBriefly() {
  std::this_thread::sleep_for(std::chrono::microseconds(500));
}

}  // namespace stereo_nav::tools
