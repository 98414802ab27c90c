#pragma once

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

#include "support/wait.h"

namespace stereo_nav::test {

/// A shell command line that runs beside the test, in a process group of its own. What it prints is kept.
class BackgroundCommand {
 public:
  explicit BackgroundCommand(const std::string& command) {
    char path[] = "/tmp/stereo_nav_output_XXXXXX";
    close(mkstemp(path));
    log_ = path;
    pid_ = fork();
    if (pid_ != 0) return;
    setpgid(0, 0);
    const std::string line = "exec >" + log_ + " 2>&1; " + command;
    execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  /// Ends the command and everything that it has started, unless it has ended.
  ~BackgroundCommand() {
    if (!status_) {
      kill(-pid_, SIGKILL);
      wait();
    }
    unlink(log_.c_str());
  }
  BackgroundCommand(const BackgroundCommand&) = delete;
  BackgroundCommand& operator=(const BackgroundCommand&) = delete;

  void signal(int number) const { kill(pid_, number); }
  pid_t pid() const { return pid_; }

  /// Waits for the end; returns the exit status, or 128 when a signal ended the command.
  int wait() {
    if (status_) return *status_;
    int status = 0;
    waitpid(pid_, &status, 0);
    keep(status);
    return *status_;
  }
  /// The exit status; nothing when the command has not ended within the time.
  std::optional<int> waitFor(double seconds) {
    const auto hasEnded = [this] {
      int status = 0;
      if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) {
        keep(status);
      }
      return status_.has_value();
    };
    waitUntil(hasEnded, seconds);
    return status_;
  }

  /// Whether it has ended, and by a signal.
  bool endedBySignal() const { return ended_by_signal_; }

  std::string output() const {
    std::ifstream file(log_);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  /// How often the command has printed `text`.
  int count(const std::string& text) const {
    const std::string all = output();
    int found = 0;
    for (auto at = all.find(text); at != std::string::npos; at = all.find(text, at + 1)) ++found;
    return found;
  }
  /// Whether the command prints `text` at least `times` times within the time.
  bool waitForOutput(const std::string& text, double seconds = kLongWait_s, int times = 1) const {
    return waitUntil([&] { return count(text) >= times; }, seconds, 0.05);
  }

 private:
  void keep(int status) {
    ended_by_signal_ = WIFSIGNALED(status);
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  }

  std::string log_;
  pid_t pid_ = 0;
  bool ended_by_signal_ = false;
  std::optional<int> status_;
};

}  // namespace stereo_nav::test
