#pragma once

#include <functional>
#include <iostream>
#include <optional>
#include <string>
#include <utility>

#include "support/background_command.h"

namespace stereo_nav::test {

/// A program that is not ours, such as rviz, beside the test. On a busy machine it may die of a signal while
/// it starts, which is no failure of ours: that is said, and it is started once more.
class ForeignProgram {
 public:
  /// `command` becomes the program (`exec`) or is a roslaunch that starts a program of this name.
  ForeignProgram(std::string name, std::string command)
      : name_(std::move(name)), command_(std::move(command)) {
    run_.emplace(command_);
  }

  /// Waits, in the time in which it starts, until the condition holds; asks every 0.1 s. False when the time
  /// has passed or the program has ended, except by its first death of a signal.
  bool comesUp(const std::function<bool()>& condition, double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
      if (run_->waitFor(0.1) && !startOnceMore()) return false;
      if (condition()) return !run_->waitFor(0.0);
      if (std::chrono::steady_clock::now() > end) return false;
    }
  }

  BackgroundCommand& command() { return *run_; }
  int starts() const { return starts_; }

 private:
  /// Whether a signal has ended the program: by the status of the command, or in the words of roslaunch,
  /// "process has died [pid 1, exit code -11, cmd /usr/bin/rviz ...]".
  bool hasDiedOfASignal() const {
    if (run_->endedBySignal()) return true;
    const std::string said = run_->output(), death = "process has died [pid ";
    for (auto at = said.find(death); at != std::string::npos; at = said.find(death, at + 1)) {
      const std::string line = said.substr(at, said.find('\n', at) - at);
      const auto command = line.find(", cmd ");
      if (command == std::string::npos || line.find(", exit code -") > command) continue;
      const std::string path = line.substr(command + 6, line.find(' ', command + 6) - command - 6);
      if (path.substr(path.rfind('/') + 1) == name_) return true;
    }
    return false;
  }

  bool startOnceMore() {
    if (starts_ > 1 || !hasDiedOfASignal()) return false;
    std::cout << name_
              << ", which is not ours, has died of a signal while it started; it is started once more. "
              << "It had said:\n"
              << run_->output() << std::endl;
    run_.emplace(command_);
    ++starts_;
    return true;
  }

  std::string name_, command_;
  std::optional<BackgroundCommand> run_;
  int starts_ = 1;
};

}  // namespace stereo_nav::test
